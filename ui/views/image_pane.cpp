#include "ui/views/image_pane.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QSignalBlocker>
#include <algorithm>
#include <cmath>

#include "core/geometry/angles.h"
#include "ui/viewmodels/age_text.h"

namespace foresight {
namespace {

/// Degrees, to the tenth that is shown, so that nothing reads "-0.0".
double ShownAngle(const CameraFrame& frame) {
  return std::round(10.0 * DegreesFromRadians(frame.motor_angle_rad)) / 10.0 + 0.0;
}

}  // namespace

ImagePane::ImagePane(SessionModel* session, FitViewModel* fit, LayersViewModel* layers,
                     QWidget* parent)
    : Pane(new ImageCanvas, tr("No scan yet: press Scan (Space)"), parent),
      session_(session),
      layers_(layers),
      canvas_(static_cast<ImageCanvas*>(Pane::Canvas())),
      tags_(new CornerTags(canvas_)),
      choice_(new QComboBox) {
  choice_->setAccessibleName(tr("Picture"));
  Controls()->addWidget(choice_);
  connect(session_, &SessionModel::scanChanged, this, [this] {
    SetHint(session_->ExpectsScan() ? tr("Scanning: the picture appears at the end")
                                    : tr("No scan yet: press Scan (Space)"));
  });
  connect(session_, &SessionModel::scanChanged, this, &ImagePane::FillChoice);
  connect(session_, &SessionModel::pictureChanged, this, &ImagePane::ShowPicture);
  connect(session_, &SessionModel::objectsChanged, this, &ImagePane::ShowOutlines);
  connect(session_, &SessionModel::depthChanged, this, &ImagePane::ShowSamples);
  connect(layers_, &LayersViewModel::changed, this, &ImagePane::ShowSamples);
  connect(session_, &SessionModel::roiChanged, this, &ImagePane::ShowRegion);
  connect(choice_, QOverload<int>::of(&QComboBox::activated), session_,
          &SessionModel::SelectPicture);
  connect(fit, &FitViewModel::changed, this,
          [this, fit] { canvas_->SetDrawing(fit->Drawing(), fit->Shape()); });
  connect(canvas_, &ImageCanvas::regionDrawn, fit, &FitViewModel::DrawRegion);
  connect(&age_timer_, &QTimer::timeout, this, &ImagePane::ShowAge);
  age_timer_.start(1000);
  FillChoice();
}

void ImagePane::FillChoice() {
  const QSignalBlocker blocker(choice_);
  choice_->clear();
  if (session_->CurrentScan())
    for (const CameraFrame& frame : session_->CurrentScan()->frames)
      choice_->addItem(tr("At %1°").arg(ShownAngle(frame), 0, 'f', 1));
  choice_->setVisible(choice_->count() > 1);
}

void ImagePane::ShowPicture() {
  const CameraFrame* picture = session_->Picture();
  ShowCanvas(picture != nullptr);
  if (picture == nullptr) {
    SetCaption({});
    return;
  }
  const QSignalBlocker blocker(choice_);
  choice_->setCurrentIndex(session_->PictureIndex());
  canvas_->SetPicture(picture->image);
  ShowAge();
  ShowOutlines();
  ShowRegion();
}

void ImagePane::ShowAge() {
  const CameraFrame* picture = session_->Picture();
  if (picture == nullptr) return;
  const qint64 age_s =
      std::max<qint64>(0, session_->ScanTime().secsTo(QDateTime::currentDateTime()));
  SetCaption(tr("Picture at %1°, scanned %2 ago")
                 .arg(ShownAngle(*picture), 0, 'f', 1)
                 .arg(AgeText(std::chrono::seconds(age_s))));
}

void ImagePane::ShowSamples() {
  const DepthResult* depth = session_->Depth().get();
  const SampleLayers& shown = layers_->Samples();
  std::vector<SampleMark> marks;
  if (depth != nullptr && shown.ShowsAny())
    marks = MarksOf(depth->samples, shown, DepthRangeOf(depth->dense.depth_m, depth->mask),
                    layers_->DepthColors());
  canvas_->SetMarks(std::move(marks));
  tags_->SetLegend(depth != nullptr ? &depth->samples : nullptr, shown);
}

void ImagePane::ShowRegion() {
  canvas_->SetRegion(RegionInPicture(*session_));
}

void ImagePane::ShowOutlines() {
  canvas_->SetOutlines(OutlinesInPicture(*session_));
}

}  // namespace foresight
