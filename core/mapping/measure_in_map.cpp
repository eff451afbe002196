#include "core/mapping/measure_in_map.h"

#include <algorithm>
#include <limits>

#include "core/measure/ground.h"

namespace foresight {
namespace {

constexpr double kSamePlace_m = 1e-3;

const MappedScan* FindScan(const MissionMap& map, const std::string& uuid) {
  for (const MappedScan& scan : map.scans)
    if (scan.uuid == uuid && scan.place.InMap()) return &scan;
  return nullptr;
}

Rigid<frame::Map, frame::Base> MapFromBase(const MappedScan& scan) {
  return scan.place.map_from_robot * scan.rig.robot_from_base;
}

/// The return of a scan that lies at a place; the map's points are single precision.
std::size_t NearestReturn(const MappedScan& scan, const Eigen::Vector3d& place) {
  const Eigen::Vector3f in_base = (MapFromBase(scan).Inverse() * place).cast<float>();
  std::size_t nearest = 0;
  float least = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < scan.cloud.points.size(); ++i) {
    const float distance2 = (scan.cloud.points[i] - in_base).squaredNorm();
    if (!(distance2 < least)) continue;  // NaN
    least = distance2;
    nearest = i;
  }
  return nearest;
}

}  // namespace

std::optional<MeasuredPoint> PickInMap(const MissionMap& map, const PointPyramid& pyramid,
                                       const CloudClick& click) {
  PyramidView view;
  view.clip_from_map = click.clip_from_robot;
  const std::vector<TaggedPoint> near =
      pyramid.SelectAll(view, {click.at - click.reach, click.at + click.reach});
  ClickChoice choice(click);
  for (std::size_t i = 0; i < near.size(); ++i) choice.Offer(i, near[i].position.cast<double>());
  const auto best = choice.Best();
  if (!best) return std::nullopt;
  const MappedScan& scan = map.scans[near[*best].tag];
  const Rigid<frame::Map, frame::Robot>& place = scan.place.map_from_robot;
  MeasuredPoint point = ReturnAt(scan.cloud, scan.rig, scan.uuid,
                                 NearestReturn(scan, near[*best].position.cast<double>()));
  point.position_m = place * point.position_m;
  point.ray = place.Rotate(point.ray);
  if (scan.place.alignment) point.placement_sigma_m = scan.place.alignment->largest_sigma_m;
  return point;
}

std::vector<Eigen::Vector3d> ReturnsWithin(const PointPyramid& pyramid,
                                           const Eigen::Vector3d& centre, double radius_m) {
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(radius_m);
  std::vector<Eigen::Vector3d> points;
  for (const TaggedPoint& point : pyramid.Within({centre - half, centre + half}))
    if ((point.position.cast<double>() - centre).norm() <= radius_m)
      points.push_back(point.position.cast<double>());
  return points;
}

Eigen::Vector3d NearestStandpoint(const MissionMap& map, const Eigen::Vector3d& place) {
  Eigen::Vector3d nearest = Eigen::Vector3d::Zero();
  double least_m = std::numeric_limits<double>::infinity();
  for (const MappedScan& scan : map.scans) {
    if (!scan.place.InMap()) continue;
    const Eigen::Vector3d at = MapFromBase(scan).translation();
    if ((at - place).norm() >= least_m) continue;
    least_m = (at - place).norm();
    nearest = at;
  }
  return nearest;
}

Result<MeasuredPlane> FindGroundInMap(const MissionMap& map, const MeasuredPoint& point,
                                      std::span<const TerrainDetection* const> terrains) {
  const MappedScan* scan = FindScan(map, point.scan_uuid);
  if (scan == nullptr)
    return Fail(ErrorCode::kInvalidInput, "the map does not hold the scan {}", point.scan_uuid);
  FORESIGHT_TRY(MeasuredPlane ground, FindGround(scan->cloud, scan->rig, terrains));
  ground.plane.normal = scan->place.map_from_robot.Rotate(ground.plane.normal);
  ground.centre = scan->place.map_from_robot * ground.centre;
  ground.plane.offset = ground.plane.normal.dot(ground.centre);
  return ground;
}

bool LiesInMap(const MissionMap& map, const Measurement& measurement) {
  if (measurement.frame != MeasureFrame::kMap) return false;
  return std::all_of(
      measurement.points.begin(), measurement.points.end(), [&](const MeasuredPoint& point) {
        const MappedScan* scan = FindScan(map, point.scan_uuid);
        if (scan == nullptr || point.source != MeasuredPoint::Source::kLidar || point.line < 0 ||
            point.beam < 0 || point.line >= scan->cloud.lines || point.beam >= scan->cloud.beams)
          return false;
        const Eigen::Vector3d now =
            MapFromBase(*scan) *
            scan->cloud.points[scan->cloud.Index(point.line, point.beam)].cast<double>();
        return (now - point.position_m).norm() <= kSamePlace_m;
      });
}

}  // namespace foresight
