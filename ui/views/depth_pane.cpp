#include "ui/views/depth_pane.h"

#include <QButtonGroup>
#include <QCheckBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QSlider>
#include <QToolButton>
#include <cmath>

#include "ui/views/color_bar.h"
#include "ui/views/templates_in_picture.h"

namespace foresight {

DepthPane::DepthPane(SessionModel* session, DepthViewModel* depth, FitViewModel* fit,
                     QWidget* parent)
    : Pane(new DepthCanvas, {}, parent),
      session_(session),
      depth_(depth),
      canvas_(static_cast<DepthCanvas*>(Pane::Canvas())) {
  BuildControls();
  BuildThreshold();
  const auto show_templates = [this] { canvas_->SetTemplates(TemplatesInPicture(*session_)); };
  connect(session_, &SessionModel::depthChanged, this, [this] {
    // The span comes from the depth's own mask, so that colours stay put while the threshold moves.
    if (const auto& depth_result = session_->Depth())
      depth_range_ = DepthRangeOf(depth_result->dense.depth_m, depth_result->mask);
    Paint();
  });
  connect(session_, &SessionModel::depthChanged, this, show_templates);
  connect(session_, &SessionModel::maskChanged, this, &DepthPane::Paint);
  connect(session_, &SessionModel::valvesChanged, this, show_templates);
  connect(session_, &SessionModel::roiChanged, this, [this] { canvas_->SetRoi(session_->Roi()); });
  connect(depth_, &DepthViewModel::thresholdChanged, this, &DepthPane::ShowThreshold);
  connect(depth_->Runner(), &TaskRunner::changed, this, &DepthPane::UpdateHint);
  connect(fit, &FitViewModel::changed, this, [this, fit] { canvas_->SetDrawing(fit->RoiTool()); });
  connect(canvas_, &DepthCanvas::roiDrawn, fit, &FitViewModel::DrawRoi);
  connect(canvas_, &DepthCanvas::pixelPointedAt, this, &DepthPane::ShowReadout);
  ShowThreshold();
  UpdateHint();
}

void DepthPane::BuildControls() {
  depth_button_ = new QToolButton;
  depth_button_->setText(tr("Depth"));
  confidence_button_ = new QToolButton;
  confidence_button_->setText(tr("Confidence"));
  confidence_button_->setToolTip(tr("How well each depth is supported by measurements"));
  auto* layers = new QButtonGroup(this);
  for (QToolButton* button : {depth_button_, confidence_button_}) {
    button->setCheckable(true);
    layers->addButton(button);
    Controls()->addWidget(button);
    connect(button, &QToolButton::clicked, this, &DepthPane::Paint);
  }
  depth_button_->setChecked(true);
  mask_box_ = new QCheckBox(tr("Mask"));
  mask_box_->setChecked(true);
  mask_box_->setToolTip(tr("Hatch the pixels whose confidence is below the threshold"));
  Controls()->addWidget(mask_box_);
  connect(mask_box_, &QCheckBox::toggled, this, &DepthPane::Paint);
}

void DepthPane::BuildThreshold() {
  slider_ = new QSlider(Qt::Horizontal);
  slider_->setRange(0, 100);
  slider_->setAccessibleName(tr("Confidence threshold"));
  threshold_value_ = new QLabel;
  threshold_value_->setMinimumWidth(40);
  readout_ = new QLabel;
  readout_->setMinimumWidth(150);
  readout_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  auto* row = new QHBoxLayout;
  row->setContentsMargins(8, 4, 8, 4);
  row->setSpacing(8);
  row->addWidget(new QLabel(tr("Threshold")));
  row->addWidget(slider_, 1);
  row->addWidget(threshold_value_);
  row->addWidget(readout_);
  Footer()->addLayout(row);
  connect(slider_, &QSlider::valueChanged, this,
          [this](int percent) { depth_->setThreshold(percent / 100.0); });
}

void DepthPane::ToggleMask() {
  mask_box_->toggle();
}

void DepthPane::ToggleLayer() {
  (depth_button_->isChecked() ? confidence_button_ : depth_button_)->click();
}

void DepthPane::Paint() {
  ShowCanvas(session_->Depth() != nullptr);
  SetCaption({});
  readout_->clear();
  if (!session_->Depth()) return;
  const DepthResult& result = *session_->Depth();
  const MaskImage* mask = mask_box_->isChecked() ? session_->Mask().get() : nullptr;
  const bool shows_depth = depth_button_->isChecked();
  const DepthLayer layer = shows_depth ? DepthLayer::kDepth : DepthLayer::kConfidence;
  const ValueRange range = shows_depth ? depth_range_ : ValueRange{0.0, 1.0};
  canvas_->SetPicture(PaintDepth(result.dense, mask, layer, range));
  Colors()->Set(shows_depth ? ColorMap::kTurbo : ColorMap::kCividis, range,
                shows_depth ? tr("depth, m") : tr("of max"));
  Colors()->show();
  SetCaption(tr("%1 % measured, %2 s")
                 .arg(100.0 * LocalDensity(result.samples), 0, 'f', 1)
                 .arg(result.seconds, 0, 'f', 2));
}

void DepthPane::ShowThreshold() {
  slider_->setValue(static_cast<int>(std::lround(100.0 * depth_->Threshold())));
  threshold_value_->setText(QString::number(depth_->Threshold(), 'f', 2));
}

void DepthPane::ShowReadout(const Eigen::Vector2d& pixel) {
  readout_->clear();
  if (!session_->Depth()) return;
  const DenseDepth& dense = session_->Depth()->dense;
  const int x = static_cast<int>(std::lround(pixel.x()));
  const int y = static_cast<int>(std::lround(pixel.y()));
  if (!dense.depth_m.Contains(x, y)) return;
  const float depth = dense.depth_m(x, y);
  readout_->setText(
      std::isfinite(depth)
          ? tr("%1 m at %2, %3").arg(static_cast<double>(depth), 0, 'f', 3).arg(x).arg(y)
          : tr("no depth at %1, %2").arg(x).arg(y));
}

void DepthPane::UpdateHint() {
  if (depth_->Runner()->Busy())
    SetHint(tr("Computing depth …"));
  else
    SetHint(tr("The depth map appears here after a scan"));
}

}  // namespace foresight
