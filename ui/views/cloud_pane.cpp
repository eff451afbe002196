#include "ui/views/cloud_pane.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLocale>
#include <QSignalBlocker>
#include <QToolButton>

#include <algorithm>

#include "core/detection/fit_in_scan.h"
#include "ui/viewmodels/no_scan_hint.h"
#include "ui/views/color_bar.h"

namespace foresight {
namespace {

constexpr int kDepthStride_px = 2;
/// Points of a map that are drawn at most.
constexpr std::size_t kMapBudget = 500'000;

}  // namespace

CloudPane::CloudPane(const CloudModels& models, QWidget* parent)
    : Pane(new CloudCanvas, NoScanHint(*models.session), parent),
      session_(models.session),
      map_(models.map),
      clip_(models.clip),
      canvas_(static_cast<CloudCanvas*>(Pane::Canvas())),
      source_(new QComboBox),
      color_(new QComboBox),
      residuals_(new QToolButton) {
  FitViewModel* fit = models.fit;
  BuildControls();
  BindMap();
  const auto show_hint = [this] {
    const bool replay = session_->Mode() == SessionMode::kReplay;
    SetHint(session_->ExpectsScan() && replay ? tr("No line had come at this moment")
            : session_->ExpectsScan()         ? tr("Scanning …")
            : session_->CurrentScan()         ? tr("Preparing the cloud …")
                                              : NoScanHint(*session_));
  };
  show_hint();  // a pane that is made late has a scan already
  for (auto signal : {&SessionModel::scanChanged, &SessionModel::earlierChanged})
    connect(session_, signal, this, show_hint);
  connect(session_, &SessionModel::cloudChanged, this, [this] {
    if (Shown() != Source::kMap) Prepare();
  });
  for (auto signal : {&SessionModel::depthChanged, &SessionModel::maskChanged})
    connect(session_, signal, this, [this] {
      if (Shown() == Source::kDepth) Prepare();
    });
  for (auto signal :
       {&SessionModel::objectsChanged, &SessionModel::roiChanged, &SessionModel::scanChanged})
    connect(session_, signal, this, &CloudPane::ShowOverlays);
  for (auto signal : {&SessionModel::objectsChanged, &SessionModel::cloudChanged})
    connect(session_, signal, this, &CloudPane::PrepareResiduals);
  PrepareResiduals();
  connect(fit, &FitViewModel::changed, this, [this, fit] { canvas_->SetDrawing(fit->Drawing()); });
  connect(canvas_, &CloudCanvas::rectangleDrawn, fit, &FitViewModel::DrawBox);
  // A pane that is made late shows what is there.
  Prepare();
  ShowOverlays();
  ShowClip();
}

void CloudPane::BindMap() {
  connect(map_, &MapViewModel::made, this, &CloudPane::ShowNewMap);
  connect(map_, &MapViewModel::changed, this, [this] {
    const bool shown = Shown() == Source::kMap;
    if (map_->Map()) {
      if (shown) ShowOverlays();
      return;
    }
    const int place = source_->findData(static_cast<int>(Source::kMap));
    if (place < 0) return;
    source_->removeItem(place);  // the map is gone
    if (!shown) return;
    source_->setCurrentIndex(0);
    FillColors();
    ShowOverlays();
    PrepareResiduals();
    canvas_->GoHome();
    Prepare();
  });
  connect(map_, &MapViewModel::centreWanted, canvas_, &CloudCanvas::LookAt);
  connect(canvas_, &CloudCanvas::viewRested, this, [this] {
    if (Shown() == Source::kMap) PrepareMap();
  });
  connect(canvas_, &CloudCanvas::refused, this, [this] {
    session_->Report({Notice::Level::kInfo, tr("This is a map of several scans."),
                      tr("Choose Lidar points above the cloud to draw a region in one scan.")});
  });
  connect(clip_, &ClipBoxModel::changed, this, &CloudPane::ShowClip);
  connect(canvas_, &CloudCanvas::clipBoxDragged, clip_, &ClipBoxModel::SetBox);
}

CloudPane::Source CloudPane::Shown() const {
  return static_cast<Source>(source_->currentData().toInt());
}

void CloudPane::ShowNewMap() {
  const int place = source_->findData(static_cast<int>(Source::kMap));
  if (place < 0) source_->addItem(tr("Map"), static_cast<int>(Source::kMap));
  source_->setCurrentIndex(source_->findData(static_cast<int>(Source::kMap)));
  FillColors();
  ShowOverlays();
  home_wanted_ = true;
  PrepareMap();
}

void CloudPane::ShowOverlays() {
  const bool map = Shown() == Source::kMap && map_->Map();
  canvas_->SetShowsScan(!map);
  map_->SetShown(map);
  if (!map) {
    canvas_->SetOutlines(OutlinesInRobot(*session_));
    canvas_->SetRegion(RegionInRobot(*session_));
    return;
  }
  constexpr Rgb8 kAppeared = {230, 159, 0}, kGone = {86, 180, 233};
  std::vector<RobotOutline> boxes;
  PointSet points;
  for (const ScanChange& change : map_->Changes()) {
    const Rgb8 color = change.kind == ScanChange::Kind::kAppeared ? kAppeared : kGone;
    const Eigen::Vector3d half = 0.5 * change.size_m;
    boxes.push_back({EdgesOf({change.centre - half, change.centre + half}), {color, 2.0f}});
    points.points.insert(points.points.end(), change.points.begin(), change.points.end());
    points.colors.resize(points.points.size(), color);
  }
  canvas_->SetOutlines(boxes);
  canvas_->SetRegion({});
  canvas_->SetResiduals(points);
}

void CloudPane::ShowClip() {
  canvas_->SetClipBox(clip_->Box());
  if (Shown() == Source::kMap && map_->Map() && !canvas_->Clip().Grabbed()) PrepareMap();
}

void CloudPane::PrepareMap() {
  if (!map_->Map()) return;
  const bool coarse = home_wanted_;
  PyramidView view;
  view.clip_from_map = canvas_->ClipFromRobot();
  view.height_px = std::max(1, canvas_->height());
  view.budget = kMapBudget;
  view.keep = clip_->Box();
  const auto work = [map = map_->Map(), view, coarse](const RunContext&) -> Result<PointSet> {
    const std::vector<TaggedPoint> points =
        coarse ? map->pyramid.Coarsest(view.budget) : map->pyramid.Select(view);
    PointSet set;
    // The view begins as that of the first scan.
    const MappedScan& first = map->map.scans.front();
    set.viewpoint =
        (first.place.map_from_robot * first.rig.robot_from_base.translation()).cast<float>();
    set.points.reserve(points.size());
    set.colors.reserve(points.size());
    for (const TaggedPoint& point : points) {
      set.points.push_back(point.position);
      set.colors.push_back(ColorOfScan(point.tag));
    }
    return set;
  };
  runner_.Run<PointSet>(tr("Preparing the map"), work, [this, coarse](const Result<PointSet>& set) {
    if (Shown() != Source::kMap || !map_->Map()) {
      if (std::exchange(outdated_, false)) Prepare();  // the map went away meanwhile
      return;
    }
    if (!set) return;
    if (coarse) {
      canvas_->SetPoints(*set, ColorMap::kTurbo, {});
      canvas_->GoHome();
      home_wanted_ = false;
    } else {
      canvas_->ReplacePoints(*set);
    }
    ShowMap(set->points.size());
    // Only now the camera stands where the picture is seen from.
    if (coarse) PrepareMap();
  });
}

void CloudPane::ShowMap(std::size_t count) {
  ShowCanvas(true);
  Colors()->setVisible(false);
  clip_->SetBounds(map_->Map()->pyramid.Bounds());
  point_count_ = count;
  const auto number = [](std::size_t value) {
    return QLocale().toString(static_cast<qulonglong>(value));
  };
  const auto& scans = map_->Map()->map.scans;
  const auto in_map = std::count_if(scans.begin(), scans.end(),
                                    [](const MappedScan& scan) { return scan.place.InMap(); });
  SetCaption(tr("Map of %1 scans: %2 of %3 points, map frame")
                 .arg(in_map)
                 .arg(number(point_count_), number(map_->Map()->pyramid.size())));
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
    ShowOverlays();
    PrepareResiduals();
    Prepare();
  });
  connect(color_, QOverload<int>::of(&QComboBox::activated), this, &CloudPane::Prepare);
  connect(reset, &QToolButton::clicked, canvas_, &CloudCanvas::ResetView);
}

void CloudPane::FillColors() {
  const QSignalBlocker blocker(color_);
  color_->clear();
  color_->setVisible(Shown() != Source::kMap);
  if (!ShowsLidar()) color_->addItem(tr("Image"), static_cast<int>(PointColor::kImage));
  color_->addItem(tr("Height"), static_cast<int>(PointColor::kHeight));
  color_->addItem(tr("Range"), static_cast<int>(PointColor::kRange));
  if (ShowsLidar()) color_->addItem(tr("Intensity"), static_cast<int>(PointColor::kIntensity));
}

PointColor CloudPane::Color() const {
  return static_cast<PointColor>(color_->currentData().toInt());
}

bool CloudPane::ShowsLidar() const {
  return Shown() == Source::kLidar;
}

bool CloudPane::HasData() const {
  if (ShowsLidar()) return session_->Cloud() != nullptr;
  return session_->Depth() && session_->CurrentImage() != nullptr;
}

void CloudPane::PrepareResiduals() {
  if (Shown() == Source::kMap) {
    residual_runner_.cancel();
    residuals_->setEnabled(false);
    return;
  }
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
    FORESIGHT_TRY(const RaySet rays, RaysInScan({object.rig, *cloud, {}, depth.get(), mask.get()},
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
  if (Shown() == Source::kMap) {
    home_wanted_ = true;
    PrepareMap();
    return;
  }
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
    if (set && HasData() && Shown() != Source::kMap) Show(*set);
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
  Eigen::AlignedBox3f bounds;
  for (const Eigen::Vector3f& point : set.points) bounds.extend(point);
  clip_->SetBounds(bounds.cast<double>());
  QString caption =
      tr("%1 points, robot frame").arg(QLocale().toString(static_cast<qulonglong>(point_count_)));
  if (const CloudPart& part = session_->Part(); part.lines > 0)
    caption += part.of_lines > 0 ? tr(", %1 of %2 lines so far").arg(part.lines).arg(part.of_lines)
                                 : tr(", %1 lines so far").arg(part.lines);
  SetCaption(caption);
}

}  // namespace foresight
