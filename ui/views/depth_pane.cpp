#include "ui/views/depth_pane.h"

#include <QAbstractItemView>
#include <QComboBox>
#include <QFrame>
#include <QHBoxLayout>
#include <QIcon>
#include <QLabel>
#include <QSignalBlocker>
#include <QSlider>
#include <QToolButton>
#include <cmath>

#include "ui/viewmodels/depth_readout.h"
#include "ui/views/color_bar.h"
#include "ui/views/compare_menu.h"
#include "ui/views/iteration_bar.h"
#include "ui/views/layers_menu.h"

namespace foresight {
namespace {

QToolButton* MenuButton(const QString& text, QMenu* menu) {
  auto* button = new QToolButton;
  button->setText(text);
  button->setPopupMode(QToolButton::InstantPopup);
  button->setMenu(menu);
  menu->setParent(button, menu->windowFlags());
  menu->setToolTipsVisible(true);
  return button;
}

}  // namespace

DepthPane::DepthPane(const DepthModels& models, QWidget* parent)
    : Pane(new DepthCanvas, {}, parent),
      session_(models.session),
      depth_(models.depth),
      layers_(models.layers),
      compare_(models.compare),
      live_(models.live),
      canvas_(static_cast<DepthCanvas*>(Pane::Canvas())),
      tags_(new CornerTags(canvas_)),
      iterations_(new IterationBar(session_, depth_, layers_)) {
  BuildControls();
  BuildFooter();
  Bind();
  FitViewModel* fit = models.fit;
  connect(fit, &FitViewModel::changed, this,
          [this, fit] { canvas_->SetDrawing(fit->Drawing(), fit->Shape()); });
  connect(canvas_, &DepthCanvas::regionDrawn, fit, &FitViewModel::DrawRegion);
  ShowMethod();
  ShowThreshold();
  ShowNewDepth();  // a pane that is made late shows what is there
}

void DepthPane::BuildControls() {
  method_ = new QComboBox;
  method_->setAccessibleName(tr("Depth method"));
  method_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  method_->setMinimumContentsLength(5);  // the pane is narrow; its list shows whole titles
  method_->view()->setMinimumWidth(method_->view()->fontMetrics().averageCharWidth() * 40);
  for (const DepthMethodInfo& info : DepthMethods()) {
    method_->addItem(QString::fromUtf8(info.title));
    method_->setItemData(method_->count() - 1, QString::fromUtf8(info.description),
                         Qt::ToolTipRole);
  }
  connect(method_, QOverload<int>::of(&QComboBox::activated), this, [this](int index) {
    depth_->setMethod(DepthMethods()[static_cast<std::size_t>(index)].method);
  });
  compare_button_ = MenuButton(tr("Compare"), new CompareMenu(session_, compare_));
  compare_button_->setToolTip(tr("Put another image right of a line you can move"));
  Controls()->addWidget(method_);
  Controls()->addWidget(MenuButton(tr("Layers"), new LayersMenu(layers_)));
  Controls()->addWidget(compare_button_);
}

void DepthPane::BuildFooter() {
  slider_ = new QSlider(Qt::Horizontal);
  slider_->setRange(0, 100);
  slider_->setAccessibleName(tr("Confidence threshold"));
  threshold_value_ = new QLabel;
  threshold_value_->setMinimumWidth(40);
  auto* row = new QHBoxLayout;
  row->setContentsMargins(8, 4, 8, 0);
  row->setSpacing(8);
  row->addWidget(new QLabel(tr("Threshold")));
  row->addWidget(slider_, 1);
  row->addWidget(threshold_value_);
  readout_ = new QLabel;
  readout_->setObjectName(QStringLiteral("faint"));
  readout_->setContentsMargins(8, 0, 8, 4);
  readout_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  readout_->setFixedHeight(2 * readout_->fontMetrics().lineSpacing() + 6);  // or the pane jumps
  readout_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  readout_->setWordWrap(true);
  Footer()->addWidget(BuildWarning());
  Footer()->addWidget(iterations_);
  Footer()->addLayout(row);
  Footer()->addWidget(readout_);
  connect(slider_, &QSlider::valueChanged, this,
          [this](int percent) { depth_->setThreshold(percent / 100.0); });
}

QWidget* DepthPane::BuildWarning() {
  warning_row_ = new QFrame;
  warning_row_->setObjectName(QStringLiteral("notice"));
  warning_row_->hide();
  auto* row = new QHBoxLayout(warning_row_);
  row->setContentsMargins(8, 4, 8, 4);
  auto* icon = new QLabel;
  icon->setPixmap(QIcon(QStringLiteral(":/icons/warning.svg")).pixmap(20, 20));
  warning_ = new QLabel;
  warning_->setWordWrap(true);
  row->addWidget(icon, 0, Qt::AlignTop);
  row->addWidget(warning_, 1);
  return warning_row_;
}

void DepthPane::Bind() {
  const auto show_outlines = [this] { canvas_->SetOutlines(OutlinesInImage(*session_)); };
  connect(session_, &SessionModel::depthChanged, this, &DepthPane::ShowNewDepth);
  connect(session_, &SessionModel::depthChanged, this, show_outlines);
  connect(session_, &SessionModel::objectsChanged, this, show_outlines);
  connect(session_, &SessionModel::maskChanged, this, &DepthPane::Paint);
  const auto show_region = [this] { canvas_->SetRegion(RegionInImage(*session_)); };
  connect(session_, &SessionModel::roiChanged, this, show_region);
  connect(session_, &SessionModel::imageChanged, this, show_region);
  connect(layers_, &LayersViewModel::changed, this, [this] {
    if (layers_->IterationsOpen()) depth_->setKeepIterations(true);
    Paint();
    PaintSecond();
    ShowMarks();
  });
  connect(depth_, &DepthViewModel::thresholdChanged, this, &DepthPane::ShowThreshold);
  connect(depth_, &DepthViewModel::methodChanged, this, &DepthPane::ShowMethod);
  connect(depth_->Runner(), &TaskRunner::changed, this, &DepthPane::ShowState);
  if (live_ != nullptr)
    connect(live_, &LiveDepthViewModel::changed, this, &DepthPane::ShowNewDepth);
  connect(compare_->Runner(), &TaskRunner::changed, this, &DepthPane::ShowState);
  connect(compare_, &CompareViewModel::changed, this, &DepthPane::ShowNewDepth);
  connect(compare_, &CompareViewModel::wipeChanged, canvas_, &DepthCanvas::SetWipe);
  connect(canvas_, &DepthCanvas::wiped, compare_, &CompareViewModel::setWipe);
  connect(canvas_, &DepthCanvas::pixelPointedAt, this, &DepthPane::ShowReadout);
}

std::shared_ptr<const DepthResult> DepthPane::Shown() const {
  if (compare_->First()) return compare_->First();
  if (session_->Depth() || live_ == nullptr) return session_->Depth();
  return live_->Depth();
}

const MaskImage* DepthPane::ShownMask() const {
  const auto result = Shown();
  if (result == nullptr) return nullptr;
  return result == session_->Depth() ? session_->Mask().get() : &result->mask;
}

void DepthPane::ShowNewDepth() {
  // The span comes from the depth's own mask, so that colours stay put while the threshold moves.
  SetCaption({});
  if (const auto result = Shown()) {
    depth_range_ = DepthRangeOf(result->dense.depth_m, result->mask);
    const QString density = QString::number(100.0 * result->density, 'f', 1);
    const QString seconds = QString::number(result->seconds, 'f', 2);
    SetCaption(tr("%1 %, %2 s").arg(density, seconds),
               tr("%1 % of the pixels were measured; the depth took %2 s").arg(density, seconds));
  }
  ShowWarning();
  Paint();
  PaintSecond();
  ShowMarks();
}

void DepthPane::ShowWarning() {
  // A running scan's preview begins with few lines: that is no reason to warn.
  warning_->setText(session_->Depth() ? DensityWarning(*session_->Depth()) : QString());
  warning_row_->setVisible(!warning_->text().isEmpty());
}

ColorImage DepthPane::Painted(const DepthResult& result, const MaskImage* mask) const {
  const MaskImage* shown = layers_->MaskShown() ? mask : nullptr;
  if (layers_->Layer() == DepthLayer::kConfidence)
    return PaintConfidence(result.dense, shown, {0.0, 1.0});
  return PaintDepth(layers_->DepthOf(result.dense), shown, layers_->DepthColors(), depth_range_);
}

void DepthPane::Paint() {
  const auto result = Shown();
  ShowCanvas(result != nullptr);
  readout_->clear();
  ShowState();
  if (!result) return;
  canvas_->SetImage(Painted(*result, ShownMask()));
  ShowColors();
}

void DepthPane::PaintSecond() {
  compare_button_->setText(compare_->With() == CompareViewModel::Kind::kNothing ? tr("Compare")
                                                                                : tr("Comparing"));
  ShowState();
  const CameraFrame* frame = session_->CurrentImage();
  if (session_->Depth() && frame && compare_->With() == CompareViewModel::Kind::kImage) {
    canvas_->SetSecond(&frame->image);
  } else if (Shown() && compare_->Second()) {
    const ColorImage second = Painted(*compare_->Second(), compare_->SecondMask().get());
    canvas_->SetSecond(&second);
  } else {
    canvas_->SetSecond(nullptr);
  }
}

void DepthPane::ShowMarks() {
  const auto marks_of = [this](const DepthResult& result) {
    return MarksOf(result.samples, layers_->Samples(), depth_range_, layers_->DepthColors());
  };
  const auto result = Shown();
  const DepthResult* second = result ? compare_->Second().get() : nullptr;
  canvas_->SetMarks(result ? marks_of(*result) : std::vector<SampleMark>());
  canvas_->SetSecondMarks(second ? std::optional(marks_of(*second)) : std::nullopt);
  tags_->SetLegend(result ? &result->samples : nullptr, layers_->Samples(),
                   second ? &second->samples : nullptr);
}

void DepthPane::ShowColors() {
  const bool absolute = Shown()->dense.max_confidence == 1.0f;
  if (layers_->Layer() == DepthLayer::kDepth)
    Colors()->Set(layers_->DepthColors(), depth_range_, tr("depth, m"));
  else
    Colors()->Set(ColorMap::kCividis, {0.0, 1.0}, absolute ? tr("confidence") : tr("of max"));
  Colors()->show();
}

void DepthPane::ShowState() {
  const auto& scan = session_->CurrentScan();
  SetHint(depth_->Runner()->Busy()       ? tr("Computing depth …")
          : scan && scan->frames.empty() ? tr("This scan holds no image, so there is no depth")
                                         : tr("The depth map appears here after a scan"));
  const bool compares = Shown() && compare_->With() != CompareViewModel::Kind::kNothing;
  const auto title = [](DepthMethod method) { return QString::fromUtf8(InfoOf(method).title); };
  QStringList left;
  if (compare_->First())
    left << compare_->FirstTitle();
  else if (compares)
    left << title(depth_->ShownOptions().method);
  if (depth_->Recomputing()) left << tr("recomputing …");
  if (!session_->Depth() && !compare_->First() && Shown())
    left << tr("Live")
         << (live_->HasOwnImage() ? tr("%1 lines") : tr("%1 lines over the last image"))
                .arg(live_->Lines());
  tags_->SetTopLeft(left.join(QStringLiteral(": ")));
  tags_->SetTopRight(!compares ? QString()
                     : compare_->Runner()->Busy()
                         ? tr("%1: computing …").arg(compare_->SecondTitle())
                         : compare_->SecondTitle());
}

void DepthPane::ShowMethod() {
  for (std::size_t i = 0; i < DepthMethods().size(); ++i)
    if (DepthMethods()[i].method == depth_->Method()) method_->setCurrentIndex(static_cast<int>(i));
  method_->setToolTip(QString::fromUtf8(InfoOf(depth_->Method()).description));
}

void DepthPane::ShowThreshold() {
  // The slider has whole percents: showing a threshold must not round it.
  const QSignalBlocker quiet(slider_);
  slider_->setValue(static_cast<int>(std::lround(100.0 * depth_->Threshold())));
  threshold_value_->setText(QString::number(depth_->Threshold(), 'f', 2));
}

QString DepthPane::Warning() const {
  return warning_row_->isVisible() ? warning_->text() : QString();
}

QString DepthPane::Readout() const {
  return readout_->text();
}

void DepthPane::ShowReadout(const Eigen::Vector2d& pixel) {
  readout_->clear();
  const auto first = compare_->First() ? compare_->First() : session_->Depth();
  if (!first) return;
  const int x = static_cast<int>(std::lround(pixel.x()));
  const int y = static_cast<int>(std::lround(pixel.y()));
  if (!first->dense.depth_m.Contains(x, y)) return;
  const bool right_of_line = (pixel.x() + 0.5) / first->samples.width > compare_->Wipe();
  const bool second = compare_->Second() && right_of_line;
  const DepthResult& result = second ? *compare_->Second() : *first;
  const DepthOptions& made_with = second              ? compare_->SecondOptions()
                                  : compare_->First() ? first->options
                                                      : depth_->ShownOptions();
  const double threshold =
      second || compare_->First() ? made_with.mask.threshold : depth_->Threshold();
  readout_->setText(TextOf(ReadDepth(
      {result, layers_->DepthOf(result.dense), threshold, SearchRadius(result, made_with)}, x, y)));
}

}  // namespace foresight
