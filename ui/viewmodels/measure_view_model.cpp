#include "ui/viewmodels/measure_view_model.h"

#include "core/measure/ground.h"
#include "core/measure/measurement_json.h"

namespace foresight {

MeasureViewModel::MeasureViewModel(SessionModel* session, QObject* parent)
    : QObject(parent), session_(session) {
  // Points of another scan do not go together with those of this one.
  connect(session_, &SessionModel::scanChanged, this, [this] {
    if (points_.empty() && !plane_) return;
    const std::string uuid = session_->ShownScan() ? session_->ShownScan()->uuid : std::string();
    if (!points_.empty() && points_.front().scan_uuid == uuid) return;
    points_.clear();
    plane_.reset();
    Q_EMIT changed();
  });
}

void MeasureViewModel::SetKind(MeasureKind kind) {
  kind_ = kind;
  on_ = true;
  points_.clear();
  plane_.reset();
  Q_EMIT changed();
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
  points_.clear();
  plane_.reset();
  Q_EMIT changed();
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

void MeasureViewModel::ClickInCloud(const CloudClick& click) {
  if (!on_ || !session_->Cloud() || !session_->ShownScan()) return;
  const auto picked =
      PickReturn(*session_->Cloud(), session_->Rig(), session_->ShownScan()->uuid, click);
  if (!picked) {
    Refuse(tr("Nothing was measured there."), tr("Click a point of the lidar."));
    return;
  }
  Take(*picked);
}

void MeasureViewModel::ClickInImage(const Eigen::Vector2d& pixel) {
  const CameraFrame* frame = session_->CurrentImage();
  if (!on_ || frame == nullptr) return;
  if (!session_->Depth()) {
    Refuse(tr("There is no depth map to measure in yet."), tr("Click in the cloud."));
    return;
  }
  const auto picked =
      PickDepth(session_->Depth()->dense.depth_m, session_->Mask().get(), *frame,
                session_->ShownScan()->rig, session_->ShownScan()->uuid, session_->ImageIndex(),
                static_cast<int>(std::lround(pixel.x())), static_cast<int>(std::lround(pixel.y())));
  if (!picked) {
    Refuse(tr("There is no depth to trust at that pixel."),
           tr("Click where the depth map is not hatched."));
    return;
  }
  Take(*picked);
}

void MeasureViewModel::ClickInSecondMap() {
  Refuse(tr("The map right of the line is only there to be compared."),
         tr("Click left of the line, or end the comparison."));
}

void MeasureViewModel::Take(MeasuredPoint point) {
  if (WantsPlane()) {
    const double radius_m = MeasuredPlaneOptions().radius_m;
    if (!session_->Cloud()) return;
    TakePlane(ReturnsWithin(*session_->Cloud(), session_->Rig(), point.position_m, radius_m),
              tr("the returns within %1 mm of the click").arg(1e3 * radius_m, 0, 'f', 0));
    return;
  }
  points_.push_back(std::move(point));
  if (static_cast<int>(points_.size()) == PointsOf(kind_)) Finish();
  Q_EMIT changed();
}

void MeasureViewModel::DrawPlane(const CloudRectangle& rectangle) {
  if (!WantsPlane() || !session_->Cloud()) return;
  const SensorRig& rig = session_->Rig();
  const auto box =
      BoxUnder(rectangle, session_->Cloud()->points.span(), rig.robot_from_base, nullptr);
  std::vector<Eigen::Vector3d> points;
  if (box)
    for (const Eigen::Vector3f& point : session_->Cloud()->points.span())
      if (point.allFinite() && box->Contains(point.cast<double>()))
        points.push_back(rig.robot_from_base * point.cast<double>());
  TakePlane(points, tr("the returns in the box that was drawn"));
}

void MeasureViewModel::TakePlane(std::span<const Eigen::Vector3d> points,
                                 const QString& made_from) {
  auto plane = FitMeasuredPlane(points, session_->Rig().robot_from_base.translation());
  if (!plane) {
    Refuse(tr("No plane was found there: %1.").arg(QString::fromStdString(plane.error().message)),
           tr("Choose a larger flat place."));
    return;
  }
  plane->made_from = made_from.toStdString();
  plane_ = std::move(*plane);
  Q_EMIT changed();
}

void MeasureViewModel::Finish() {
  std::vector<MeasuredPoint> points = std::exchange(points_, {});
  std::optional<MeasuredPlane> plane = std::exchange(plane_, std::nullopt);
  if (kind_ == MeasureKind::kHeight) {
    std::vector<const TerrainDetection*> terrains;
    for (const FoundObject& object : session_->Objects())
      if (const auto* terrain = std::get_if<TerrainDetection>(&object.detection);
          terrain != nullptr && session_->IsCurrent(object))
        terrains.push_back(terrain);
    auto ground = session_->Cloud()
                      ? FindGround(*session_->Cloud(), session_->Rig(), terrains)
                      : Result<MeasuredPlane>(Fail(ErrorCode::kTooFewPoints, "there is no cloud"));
    if (!ground) {
      Refuse(tr("The ground is not known: %1.").arg(QString::fromStdString(ground.error().message)),
             tr("Fit the terrain first, or measure the distance to a plane."));
      return;
    }
    plane = std::move(*ground);
  }
  const std::string scan_uuid = points.front().scan_uuid;
  const auto measured = Measure(kind_, std::move(points), std::move(plane));
  if (!measured) {
    Refuse(tr("This is no measurement: %1.").arg(QString::fromStdString(measured.error().message)),
           tr("Choose other points."));
    return;
  }
  NoteRecord record;
  record.kind = kMeasurementKind;
  record.scan_uuid = scan_uuid;
  record.json = MeasurementToJson(*measured);
  (void)session_->Notes()->Add(std::move(record));  // it has no tags that could be refused
}

}  // namespace foresight
