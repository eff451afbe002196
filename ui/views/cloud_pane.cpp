#include "ui/views/cloud_pane.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLocale>
#include <QSignalBlocker>
#include <QToolButton>

#include "core/detection/fit_in_scan.h"
#include "ui/views/color_bar.h"

namespace foresight {
namespace {

constexpr int kDepthStride_px = 2;

}  // namespace

CloudPane::CloudPane(SessionModel* session, FitViewModel* fit, QWidget* parent)
    : Pane(new CloudCanvas, tr("No scan yet: press Scan (Space)"), parent),
      session_(session),
      canvas_(static_cast<CloudCanvas*>(Pane::Canvas())),
      source_(new QComboBox),
      color_(new QComboBox),
      residuals_(new QToolButton) {
  BuildControls();
  connect(session_, &SessionModel::scanChanged, this, [this] {
    const bool replay = session_->Mode() == SessionMode::kReplay;
    SetHint(session_->ExpectsScan() && replay ? tr("No line had come at this moment")
            : session_->ExpectsScan()         ? tr("Scanning …")
            : session_->CurrentScan()         ? tr("Preparing the cloud …")
                                              : tr("No scan yet: press Scan (Space)"));
  });
  connect(session_, &SessionModel::cloudChanged, this, &CloudPane::Prepare);
  for (auto signal : {&SessionModel::depthChanged, &SessionModel::maskChanged})
    connect(session_, signal, this, [this] {
      if (!ShowsLidar()) Prepare();
    });
  connect(session_, &SessionModel::objectsChanged, this,
          [this] { canvas_->SetOutlines(OutlinesInRobot(*session_)); });
  for (auto signal : {&SessionModel::objectsChanged, &SessionModel::cloudChanged})
    connect(session_, signal, this, &CloudPane::PrepareResiduals);
  PrepareResiduals();
  connect(session_, &SessionModel::roiChanged, this,
          [this] { canvas_->SetRegion(RegionInRobot(*session_)); });
  connect(fit, &FitViewModel::changed, this, [this, fit] { canvas_->SetDrawing(fit->Drawing()); });
  connect(canvas_, &CloudCanvas::rectangleDrawn, fit, &FitViewModel::DrawBox);
  connect(session_, &SessionModel::scanChanged, this,
          [this] { canvas_->SetOutlines(OutlinesInRobot(*session_)); });
  // A pane that is made late shows what is there.
  Prepare();
  canvas_->SetOutlines(OutlinesInRobot(*session_));
  canvas_->SetRegion(RegionInRobot(*session_));
}

void CloudPane::BuildControls() {
  source_->setAccessibleName(tr("Points of"));
  source_->addItem(tr("Lidar points"), static_cast<int>(Source::kLidar));
  source_->addItem(tr("Depth map"), static_cast<int>(Source::kDepth));
  color_->setAccessibleName(tr("Coloured by"));
  FillColors();
  auto* reset = new QToolButton;
  reset->setText(tr("Reset view"));
  reset->setToolTip(tr("Look ahead of the robot again (Home)"));
  Controls()->addWidget(source_);
  Controls()->addWidget(color_);
  residuals_->setText(tr("Residuals"));
  residuals_->setCheckable(true);
  residuals_->setToolTip(
      tr("Colour the region's points by how far they are from the outline: blue "
         "behind it, orange in front of it, 30 mm at full colour"));
  Controls()->addWidget(residuals_);
  Controls()->addWidget(reset);
  connect(residuals_, &QToolButton::toggled, this, &CloudPane::PrepareResiduals);
  connect(source_, QOverload<int>::of(&QComboBox::activated), this, [this] {
    FillColors();
    Prepare();
  });
  connect(color_, QOverload<int>::of(&QComboBox::activated), this, &CloudPane::Prepare);
  connect(reset, &QToolButton::clicked, canvas_, &CloudCanvas::ResetView);
}

void CloudPane::FillColors() {
  const QSignalBlocker blocker(color_);
  color_->clear();
  if (!ShowsLidar()) color_->addItem(tr("Image"), static_cast<int>(PointColor::kImage));
  color_->addItem(tr("Height"), static_cast<int>(PointColor::kHeight));
  color_->addItem(tr("Range"), static_cast<int>(PointColor::kRange));
  if (ShowsLidar()) color_->addItem(tr("Intensity"), static_cast<int>(PointColor::kIntensity));
}

PointColor CloudPane::Color() const {
  return static_cast<PointColor>(color_->currentData().toInt());
}

bool CloudPane::ShowsLidar() const {
  return source_->currentData().toInt() == static_cast<int>(Source::kLidar);
}

bool CloudPane::HasData() const {
  if (ShowsLidar()) return session_->Cloud() != nullptr;
  return session_->Depth() && session_->CurrentImage() != nullptr;
}

void CloudPane::PrepareResiduals() {
  const FoundObject* object = session_->Selected();
  const bool possible = object != nullptr && session_->IsCurrent(*object) && session_->Cloud();
  residuals_->setEnabled(possible);
  const bool raw = possible && OriginOf(object->detection).source == "raw";
  if (!possible || !residuals_->isChecked() || (!raw && !session_->Depth())) {
    residual_runner_.cancel();
    canvas_->SetResiduals({});
    return;
  }
  const auto work = [object = *object, candidate = session_->Candidate(), cloud = session_->Cloud(),
                     depth = session_->Depth(), mask = session_->Mask(),
                     raw](const RunContext&) -> Result<PointSet> {
    FORESIGHT_TRY(const RaySet rays, RaysInScan({object.rig, *cloud, depth.get(), mask.get()},
                                                raw ? FitSource::kRaw : FitSource::kDepthAlone,
                                                OriginOf(object.detection).roi));
    return PointsOf(ResidualsOf(object.detection, candidate, rays), object.rig);
  };
  residual_runner_.Run<PointSet>(
      tr("Colouring the residuals"), work, [this](const Result<PointSet>& set) {
        canvas_->SetResiduals(set && residuals_->isChecked() ? *set : PointSet());
      });
}

void CloudPane::Prepare() {
  if (!HasData()) {
    ShowCanvas(false);
    SetCaption({});
    point_count_ = 0;
    return;
  }
  if (runner_.Busy()) {
    // Not replaced at once: while a scan runs newer data come faster than a slow machine prepares.
    outdated_ = true;
    return;
  }
  const auto work = [lidar = ShowsLidar(), cloud = session_->Cloud(), rig = session_->Rig(),
                     scan = session_->CurrentScan(), image = session_->ImageIndex(),
                     depth = session_->Depth(), mask = session_->Mask(),
                     color = Color()](const RunContext&) -> Result<PointSet> {
    if (lidar) return PointsOf(*cloud, rig, color);
    return PointsOf(depth->dense.depth_m, mask.get(), scan->frames[static_cast<std::size_t>(image)],
                    scan->rig, color, kDepthStride_px);
  };
  runner_.Run<PointSet>(tr("Preparing the cloud"), work, [this](const Result<PointSet>& set) {
    if (set && HasData()) Show(*set);
    if (std::exchange(outdated_, false)) Prepare();
  });
}

void CloudPane::Show(const PointSet& set) {
  QString title;
  ColorMap map = ColorMap::kTurbo;
  switch (Color()) {
    case PointColor::kHeight:
      title = tr("height, m");
      break;
    case PointColor::kRange:
      title = tr("range, m");
      break;
    case PointColor::kIntensity:
      title = tr("intensity");
      map = ColorMap::kGray;
      break;
    case PointColor::kImage:
      break;
  }
  ShowCanvas(true);
  const ValueRange range = RobustRange(set.values);
  canvas_->SetPoints(set, map, range);
  Colors()->Set(map, range, title);
  Colors()->setVisible(!set.values.empty());
  point_count_ = set.points.size();
  QString caption =
      tr("%1 points, robot frame").arg(QLocale().toString(static_cast<qulonglong>(point_count_)));
  if (const CloudPart& part = session_->Part(); part.lines > 0)
    caption += part.of_lines > 0 ? tr(", %1 of %2 lines so far").arg(part.lines).arg(part.of_lines)
                                 : tr(", %1 lines so far").arg(part.lines);
  SetCaption(caption);
}

}  // namespace foresight
