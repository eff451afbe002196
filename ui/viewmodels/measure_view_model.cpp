#include "ui/viewmodels/measure_view_model.h"

#include "core/measure/measurement_json.h"

namespace foresight {

MeasureViewModel::MeasureViewModel(SessionModel* session, MapViewModel* map, QObject* parent)
    : QObject(parent), session_(session), map_(map) {
  // Points of another scan do not go together with those of this one.
  connect(session_, &SessionModel::scanChanged, this, [this] {
    if (!Begun() || frame_ == MeasureFrame::kMap) return;
    const std::string uuid = session_->ShownScan() ? session_->ShownScan()->uuid : std::string();
    if (points_.empty() || points_.front().scan_uuid != uuid) DropPoints();
  });
  // Nor do those of another map.
  for (auto signal : {&MapViewModel::shownChanged, &MapViewModel::made})
    connect(map_, signal, this, [this] {
      if (Begun() && frame_ == MeasureFrame::kMap) return DropPoints();
      Q_EMIT changed();  // other measurements are drawn
    });
}

const MissionMap* MeasureViewModel::ShownMapOrNull() const {
  return map_->Shown() ? &map_->Map()->map : nullptr;
}

std::unique_ptr<MeasureSource> MeasureViewModel::InCloud() const {
  return map_->Shown() ? SourceInMap(map_->Map(), *session_) : SourceInScan(*session_);
}

void MeasureViewModel::DropPoints() {
  points_.clear();
  plane_.reset();
  Q_EMIT changed();
}

void MeasureViewModel::SetKind(MeasureKind kind) {
  kind_ = kind;
  on_ = true;
  DropPoints();
}

void MeasureViewModel::toggle() {
  if (on_)
    leave();
  else
    SetKind(kind_);
}

void MeasureViewModel::leave() {
  if (!on_) return;
  on_ = false;
  DropPoints();
}

void MeasureViewModel::back() {
  if (!CanTakeBack()) return;
  if (points_.empty())
    plane_.reset();
  else
    points_.pop_back();
  Q_EMIT changed();
}

QString MeasureViewModel::Hint() const {
  if (!on_) return {};
  if (WantsPlane())
    return tr("Click a flat place, or draw a box over it with Shift: the plane is fitted there");
  switch (kind_) {
    case MeasureKind::kPoint:
      return tr("Click a point");
    case MeasureKind::kDistance:
      return points_.empty() ? tr("Click the first point") : tr("Click the second point");
    case MeasureKind::kAngle:
      return points_.empty()       ? tr("Click a point on the first leg")
             : points_.size() == 1 ? tr("Click the corner")
                                   : tr("Click a point on the second leg");
    case MeasureKind::kPlaneDistance:
      return tr("Click the point whose distance from the plane is wanted");
    case MeasureKind::kHeight:
      break;
  }
  return tr("Click the point whose height above the ground is wanted");
}

void MeasureViewModel::Refuse(const QString& what, const QString& next) {
  session_->Report({Notice::Level::kInfo, what, next});
}

bool MeasureViewModel::GoesWithPoints(MeasureFrame frame) {
  if (!Begun() || frame == frame_) return true;
  if (frame_ == MeasureFrame::kMap)
    Refuse(tr("What was clicked before is in the map."),
           tr("Click in the map, or take the point back (Backspace)."));
  else
    Refuse(tr("What was clicked before is in a scan."),
           tr("Click in the image, or take the point back (Backspace)."));
  return false;
}

void MeasureViewModel::ClickInCloud(const CloudClick& click) {
  const auto source = InCloud();
  if (!on_ || !source || !GoesWithPoints(source->Frame())) return;
  const auto picked = source->Pick(click);
  if (!picked) {
    Refuse(tr("Nothing was measured there."), tr("Click a point of the lidar."));
    return;
  }
  Take(*picked, *source);
}

void MeasureViewModel::ClickInImage(const Eigen::Vector2d& pixel) {
  const CameraFrame* frame = session_->CurrentImage();
  if (!on_ || frame == nullptr) return;
  const auto source = SourceInScan(*session_);
  if (!session_->Depth() || !source) {
    Refuse(tr("There is no depth map to measure in yet."), tr("Click in the cloud."));
    return;
  }
  if (!GoesWithPoints(source->Frame())) return;
  const auto picked =
      PickDepth(session_->Depth()->dense.depth_m, session_->Mask().get(), *frame,
                session_->ShownScan()->rig, session_->ShownScan()->uuid, session_->ImageIndex(),
                static_cast<int>(std::lround(pixel.x())), static_cast<int>(std::lround(pixel.y())));
  if (!picked) {
    Refuse(tr("There is no depth to trust at that pixel."),
           tr("Click where the depth map is not hatched."));
    return;
  }
  Take(*picked, *source);
}

void MeasureViewModel::ClickInSecondMap() {
  Refuse(tr("The map right of the line is only there to be compared."),
         tr("Click left of the line, or end the comparison."));
}

void MeasureViewModel::Take(MeasuredPoint point, const MeasureSource& source) {
  if (WantsPlane()) {
    const double radius_m = MeasuredPlaneOptions().radius_m;
    TakePlane(source.Around(point.position_m, radius_m),
              tr("the returns within %1 mm of the click").arg(1e3 * radius_m, 0, 'f', 0), source);
    return;
  }
  frame_ = source.Frame();
  points_.push_back(std::move(point));
  if (static_cast<int>(points_.size()) == PointsOf(kind_)) Finish(source);
  Q_EMIT changed();
}

void MeasureViewModel::DrawPlane(const CloudRectangle& rectangle) {
  const auto source = InCloud();
  if (!WantsPlane() || !source) return;
  TakePlane(source->Under(rectangle), tr("the returns in the box that was drawn"), *source);
}

void MeasureViewModel::TakePlane(std::span<const Eigen::Vector3d> points, const QString& made_from,
                                 const MeasureSource& source) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) middle += point / static_cast<double>(points.size());
  auto plane = FitMeasuredPlane(points, source.SeenFrom(middle));
  if (!plane) {
    Refuse(tr("No plane was found there: %1.").arg(QString::fromStdString(plane.error().message)),
           tr("Choose a larger flat place."));
    return;
  }
  plane->made_from = made_from.toStdString();
  plane_ = std::move(*plane);
  frame_ = source.Frame();
  Q_EMIT changed();
}

void MeasureViewModel::Finish(const MeasureSource& source) {
  std::vector<MeasuredPoint> points = std::exchange(points_, {});
  std::optional<MeasuredPlane> plane = std::exchange(plane_, std::nullopt);
  if (kind_ == MeasureKind::kHeight) {
    auto ground = source.Ground(points.front());
    if (!ground) {
      Refuse(tr("The ground is not known: %1.").arg(QString::fromStdString(ground.error().message)),
             tr("Fit the terrain first, or measure the distance to a plane."));
      return;
    }
    plane = std::move(*ground);
  }
  NoteRecord record;
  record.kind = kMeasurementKind;
  // A map is of the mission, whichever scan is on the screen.
  if (frame_ == MeasureFrame::kRobot) record.scan_uuid = points.front().scan_uuid;
  const auto measured = Measure(kind_, std::move(points), std::move(plane), frame_);
  if (!measured) {
    Refuse(tr("This is no measurement: %1.").arg(QString::fromStdString(measured.error().message)),
           tr("Choose other points."));
    return;
  }
  record.json = MeasurementToJson(*measured);
  (void)session_->Notes()->Add(std::move(record));  // it has no tags that could be refused
}

}  // namespace foresight
