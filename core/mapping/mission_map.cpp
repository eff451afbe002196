#include "core/mapping/mission_map.h"

namespace foresight {
namespace {

Result<PlacedScan> Placed(const MissionMap& map, std::int64_t id) {
  for (const MappedScan& scan : map.scans) {
    if (scan.id != id) continue;
    if (!scan.place.InMap())
      return Fail(ErrorCode::kInvalidInput, "scan {} is not in the map: {}", id,
                  scan.place.failure);
    return PlacedScan{scan.cloud, scan.place.map_from_robot * scan.rig.robot_from_base};
  }
  return Fail(ErrorCode::kInvalidInput, "scan {} is not among those of the map", id);
}

}  // namespace

Result<MissionMap> MapMission(const MissionFile& mission, const std::vector<std::int64_t>& ids,
                              const MapOdometry& odometry, const RunContext& context) {
  std::vector<std::int64_t> wanted = ids;
  if (wanted.empty()) {
    FORESIGHT_TRY(const std::vector<ScanSummary> list, mission.ListScans());
    for (const ScanSummary& scan : list) wanted.push_back(scan.id);
  }
  MissionMap map;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (context.Cancelled()) return Fail(ErrorCode::kCancelled, "the map was cancelled");
    context.Report(0.3 * static_cast<double>(i) / static_cast<double>(wanted.size()),
                   "loading scans");
    MappedScan entry;
    entry.id = wanted[i];
    FORESIGHT_TRY(const Scan scan, mission.LoadScan(entry.id));
    entry.uuid = scan.uuid;
    entry.rig = scan.rig;
    const auto cloud = RegisterScan(scan, {});
    if (!cloud) {
      map.left_out.push_back(
          fmt::format("scan {} is left out: {}", entry.id, cloud.error().message));
      continue;
    }
    entry.cloud = *cloud;
    map.scans.push_back(std::move(entry));
  }
  if (map.scans.empty())
    return Fail(ErrorCode::kInvalidInput, "{}: holds no scan with a return",
                mission.path().string());
  std::vector<ScanForMap> inputs;
  for (const MappedScan& entry : map.scans) {
    const auto pose = odometry.find(entry.id);
    inputs.push_back({entry.cloud, entry.rig,
                      pose == odometry.end() ? std::nullopt : std::optional(pose->second)});
  }
  FORESIGHT_TRY(std::vector<MapPlace> places, PlaceScans(inputs, {}, context.Part(0.3, 1.0)));
  for (std::size_t i = 0; i < places.size(); ++i) map.scans[i].place = std::move(places[i]);
  return map;
}

std::string PlaceText(const MappedScan& scan) {
  if (!scan.place.InMap())
    return fmt::format("scan {}: not in the map: {}", scan.id, scan.place.failure);
  const Eigen::Vector3d& t = scan.place.map_from_robot.translation();
  std::string text =
      fmt::format("scan {}: robot at ({:.3f}, {:.3f}, {:.3f}) m", scan.id, t.x(), t.y(), t.z());
  if (!scan.place.alignment) return text + ", the map's frame";
  const CloudAlignment& a = *scan.place.alignment;
  text += fmt::format(", {:.1f} mm rms over {:.0f} % of its points", 1e3 * a.rms_m,
                      100.0 * a.overlap_ratio);
  for (const std::string& sentence : a.undetermined) text += "; " + sentence;
  return text;
}

Result<ScanChanges> FindChangesInMap(const MissionMap& map, std::int64_t before, std::int64_t after,
                                     const ScanChangeOptions& options, const RunContext& context) {
  FORESIGHT_TRY(const PlacedScan earlier, Placed(map, before));
  FORESIGHT_TRY(const PlacedScan later, Placed(map, after));
  return FindChanges(earlier, later, options, context);
}

std::string ChangeText(const ScanChange& change) {
  return fmt::format("{}: {} points round ({:.2f}, {:.2f}, {:.2f}) m, {:.2f} x {:.2f} x {:.2f} m",
                     ToString(change.kind), change.points.size(), change.centre.x(),
                     change.centre.y(), change.centre.z(), change.size_m.x(), change.size_m.y(),
                     change.size_m.z());
}

std::vector<TaggedPoint> PointsOfMap(const MissionMap& map) {
  std::vector<TaggedPoint> points;
  for (std::size_t i = 0; i < map.scans.size(); ++i) {
    const MappedScan& scan = map.scans[i];
    if (!scan.place.InMap()) continue;
    const auto map_from_base = scan.place.map_from_robot * scan.rig.robot_from_base;
    const Eigen::Matrix3f rotation = map_from_base.RotationMatrix().cast<float>();
    const Eigen::Vector3f translation = map_from_base.translation().cast<float>();
    for (const Eigen::Vector3f& point : scan.cloud.points.span())
      if (point.allFinite())
        points.push_back({rotation * point + translation, static_cast<std::uint32_t>(i)});
  }
  return points;
}

}  // namespace foresight
