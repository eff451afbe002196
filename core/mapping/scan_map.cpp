#include "core/mapping/scan_map.h"

namespace foresight {
namespace {

using Pose = Rigid<frame::Map, frame::Robot>;

/// From where the scan is aligned.
Pose GuessOf(const ScanForMap& scan, const ScanForMap& last, const MapPlace& last_place) {
  if (!scan.odometry || !last.odometry) return last_place.map_from_robot;
  const Rigid<frame::Robot, frame::Robot> step = last.odometry->Inverse() * *scan.odometry;
  return last_place.map_from_robot * step;
}

}  // namespace

Result<std::vector<MapPlace>> PlaceScans(const std::vector<ScanForMap>& scans,
                                         const AlignCloudsOptions& options,
                                         const RunContext& context) {
  FORESIGHT_CHECK(options.Check());
  if (scans.empty()) return Fail(ErrorCode::kInvalidInput, "a map needs a scan");
  std::vector<Eigen::Vector3f> map = ReturnsInRobot(scans.front().cloud, scans.front().rig);
  if (map.empty()) return Fail(ErrorCode::kTooFewPoints, "the first scan of the map has no return");
  std::vector<MapPlace> places(scans.size());
  std::size_t last = 0;
  for (std::size_t i = 1; i < scans.size(); ++i) {
    const auto all = static_cast<double>(scans.size() - 1), at = static_cast<double>(i - 1);
    const std::vector<Eigen::Vector3f> points = ReturnsInRobot(scans[i].cloud, scans[i].rig);
    auto alignment = AlignClouds(map, points, GuessOf(scans[i], scans[last], places[last]), options,
                                 context.Part(at / all, (at + 1.0) / all));
    if (!alignment) {
      if (alignment.error().code == ErrorCode::kCancelled) return tl::unexpected(alignment.error());
      places[i].failure = alignment.error().message;
      continue;
    }
    places[i].map_from_robot = alignment->map_from_robot;
    for (const Eigen::Vector3f& point : points)
      map.push_back((alignment->map_from_robot * point.cast<double>()).cast<float>());
    places[i].alignment = std::move(*alignment);
    last = i;
  }
  return places;
}

}  // namespace foresight
