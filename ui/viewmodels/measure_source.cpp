#include "ui/viewmodels/measure_source.h"

#include "core/mapping/measure_in_map.h"
#include "core/measure/ground.h"

namespace foresight {
namespace {

/// Those that were found in a scan.
std::vector<const TerrainDetection*> TerrainsOf(const SessionModel& session,
                                                const std::string& scan_uuid) {
  std::vector<const TerrainDetection*> terrains;
  for (const FoundObject& object : session.Objects())
    if (const auto* terrain = std::get_if<TerrainDetection>(&object.detection);
        terrain != nullptr && object.scan_uuid == scan_uuid)
      terrains.push_back(terrain);
  return terrains;
}

class ScanSource : public MeasureSource {
 public:
  explicit ScanSource(const SessionModel& session) : session_(session) {}

  MeasureFrame Frame() const override { return MeasureFrame::kRobot; }
  std::optional<MeasuredPoint> Pick(const CloudClick& click) const override {
    return PickReturn(*session_.Cloud(), session_.Rig(), session_.ShownScan()->uuid, click);
  }
  std::vector<Eigen::Vector3d> Around(const Eigen::Vector3d& place,
                                      double radius_m) const override {
    return ReturnsWithin(*session_.Cloud(), session_.Rig(), place, radius_m);
  }
  std::vector<Eigen::Vector3d> Under(const CloudRectangle& rectangle) const override {
    const auto& robot_from_base = session_.Rig().robot_from_base;
    const auto box = BoxUnder(rectangle, session_.Cloud()->points.span(), robot_from_base, nullptr);
    std::vector<Eigen::Vector3d> points;
    if (!box) return points;
    for (const Eigen::Vector3f& point : session_.Cloud()->points.span())
      if (point.allFinite() && box->Contains(point.cast<double>()))
        points.push_back(robot_from_base * point.cast<double>());
    return points;
  }
  Eigen::Vector3d SeenFrom(const Eigen::Vector3d&) const override {
    return session_.Rig().robot_from_base.translation();
  }
  Result<MeasuredPlane> Ground(const MeasuredPoint& point) const override {
    return FindGround(*session_.Cloud(), session_.Rig(), TerrainsOf(session_, point.scan_uuid));
  }

 private:
  const SessionModel& session_;
};

class MapSource : public MeasureSource {
 public:
  MapSource(std::shared_ptr<const ShownMap> map, const SessionModel& session)
      : map_(std::move(map)), session_(session) {}

  MeasureFrame Frame() const override { return MeasureFrame::kMap; }
  std::optional<MeasuredPoint> Pick(const CloudClick& click) const override {
    return PickInMap(map_->map, map_->pyramid, click);
  }
  std::vector<Eigen::Vector3d> Around(const Eigen::Vector3d& place,
                                      double radius_m) const override {
    return ReturnsWithin(map_->pyramid, place, radius_m);
  }
  std::vector<Eigen::Vector3d> Under(const CloudRectangle& rectangle) const override {
    PyramidView view;
    view.clip_from_map = rectangle.clip_from_robot;
    std::vector<Eigen::Vector3f> seen;
    for (const TaggedPoint& point :
         map_->pyramid.SelectAll(view, {rectangle.corners.low, rectangle.corners.high}))
      seen.push_back(point.position);
    // The map's frame in the place of both: a box along its axes.
    const auto box = BoxUnder(rectangle, seen, {}, nullptr);
    std::vector<Eigen::Vector3d> points;
    if (!box) return points;
    for (const Eigen::Vector3f& point : seen)
      if (box->Contains(point.cast<double>())) points.push_back(point.cast<double>());
    return points;
  }
  Eigen::Vector3d SeenFrom(const Eigen::Vector3d& place) const override {
    return NearestStandpoint(map_->map, place);
  }
  Result<MeasuredPlane> Ground(const MeasuredPoint& point) const override {
    return FindGroundInMap(map_->map, point, TerrainsOf(session_, point.scan_uuid));
  }

 private:
  std::shared_ptr<const ShownMap> map_;
  const SessionModel& session_;
};

}  // namespace

std::unique_ptr<MeasureSource> SourceInScan(const SessionModel& session) {
  if (!session.Cloud() || !session.ShownScan()) return nullptr;
  return std::make_unique<ScanSource>(session);
}

std::unique_ptr<MeasureSource> SourceInMap(std::shared_ptr<const ShownMap> map,
                                           const SessionModel& session) {
  return std::make_unique<MapSource>(std::move(map), session);
}

}  // namespace foresight
