#include "ui/views/image_pane.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QSignalBlocker>
#include <algorithm>
#include <cmath>

#include "core/geometry/angles.h"
#include "ui/viewmodels/age_text.h"
#include "ui/viewmodels/no_scan_hint.h"

namespace foresight {
namespace {

/// Degrees, to the tenth that is shown, so that nothing reads "-0.0".
double ShownAngle(const CameraFrame& frame) {
  return std::round(10.0 * DegreesFromRadians(frame.motor_angle_rad)) / 10.0 + 0.0;
}

}  // namespace

ImagePane::ImagePane(SessionModel* session, FitViewModel* fit, LayersViewModel* layers,
                     QWidget* parent)
    : Pane(new ImageCanvas, NoScanHint(*session), parent),
      session_(session),
      layers_(layers),
      canvas_(static_cast<ImageCanvas*>(Pane::Canvas())),
      tags_(new CornerTags(canvas_)),
      choice_(new QComboBox) {
  choice_->setAccessibleName(tr("Image"));
  Controls()->addWidget(choice_);
  const auto show_hint = [this] {
    const bool replay = session_->Mode() == SessionMode::kReplay;
    SetHint(replay && session_->ExpectsScan()
                ? tr("The image appears at the moment at which it was taken")
            : session_->ExpectsScan() ? tr("Scanning: the image appears when it is taken")
            : session_->CurrentScan() ? tr("This scan holds no image")
                                      : NoScanHint(*session_));
  };
  show_hint();
  for (auto signal : {&SessionModel::scanChanged, &SessionModel::earlierChanged})
    connect(session_, signal, this, show_hint);
  connect(session_, &SessionModel::scanChanged, this, &ImagePane::FillChoice);
  connect(session_, &SessionModel::imageChanged, this, &ImagePane::ShowImage);
  connect(session_, &SessionModel::objectsChanged, this, &ImagePane::ShowOutlines);
  connect(session_, &SessionModel::depthChanged, this, &ImagePane::ShowSamples);
  connect(layers_, &LayersViewModel::changed, this, &ImagePane::ShowSamples);
  connect(session_, &SessionModel::roiChanged, this, &ImagePane::ShowRegion);
  connect(choice_, QOverload<int>::of(&QComboBox::activated), session_, &SessionModel::SelectImage);
  connect(fit, &FitViewModel::changed, this,
          [this, fit] { canvas_->SetDrawing(fit->Drawing(), fit->Shape()); });
  connect(canvas_, &ImageCanvas::regionDrawn, fit, &FitViewModel::DrawRegion);
  connect(&age_timer_, &QTimer::timeout, this, &ImagePane::ShowAge);
  age_timer_.start(1000);
  // A pane that is made late shows what is there.
  FillChoice();
  ShowImage();
  ShowSamples();
}

void ImagePane::FillChoice() {
  const QSignalBlocker blocker(choice_);
  choice_->clear();
  if (session_->ShownScan())
    for (const CameraFrame& frame : session_->ShownScan()->frames)
      choice_->addItem(tr("At %1°").arg(ShownAngle(frame), 0, 'f', 1));
  choice_->setVisible(choice_->count() > 1);
}

void ImagePane::ShowImage() {
  const CameraFrame* capture = session_->CurrentImage();
  ShowCanvas(capture != nullptr);
  if (capture == nullptr) {
    SetCaption({});
    return;
  }
  const QSignalBlocker blocker(choice_);
  choice_->setCurrentIndex(session_->ImageIndex());
  canvas_->SetImage(capture->image);
  ShowAge();
  ShowOutlines();
  ShowRegion();
}

void ImagePane::ShowAge() {
  const CameraFrame* capture = session_->CurrentImage();
  if (capture == nullptr) return;
  const qint64 age_s =
      std::max<qint64>(0, session_->ScanTime().secsTo(QDateTime::currentDateTime()));
  const QString caption = tr("Image at %1°, scanned %2 ago")
                              .arg(ShownAngle(*capture), 0, 'f', 1)
                              .arg(AgeText(std::chrono::seconds(age_s)));
  SetCaption(caption);
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
  canvas_->SetRegion(RegionInImage(*session_));
}

void ImagePane::ShowOutlines() {
  canvas_->SetOutlines(OutlinesInImage(*session_));
}

}  // namespace foresight
