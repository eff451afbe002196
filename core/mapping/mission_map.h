#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/mapping/map_odometry.h"
#include "core/mapping/point_pyramid.h"
#include "core/mapping/scan_changes.h"
#include "core/mapping/scan_map.h"
#include "core/mission/mission_file.h"

namespace foresight {

/// A scan of a mission with its points and its place in the map.
struct MappedScan {
  std::int64_t id = 0;
  std::string uuid;
  SensorRig rig;
  RegisteredScan cloud;
  MapPlace place;
};

/// Scans of a mission in one frame.
struct MissionMap {
  std::vector<MappedScan> scans;
  /// Scans without a return, which no map can hold: why, one sentence each.
  std::vector<std::string> left_out;
};

/// Loads the scans, all where `ids` is empty, and brings them together (PlaceScans) in the order of
/// `ids`. Fails as MissionFile does, with kInvalidInput where no scan has a return, and kCancelled.
Result<MissionMap> MapMission(const MissionFile& mission, const std::vector<std::int64_t>& ids,
                              const MapOdometry& odometry, const RunContext& context);

/// "scan 2: robot at (0.400, 0.301, 0.000) m, 8.1 mm rms over 84 % of its points", or why it is not
/// in the map; what is not determined behind it.
std::string PlaceText(const MappedScan& scan);

/// What changed from one scan of the map to another, by their numbers. Fails as FindChanges, and
/// with kInvalidInput where one of them is not in the map.
Result<ScanChanges> FindChangesInMap(const MissionMap& map, std::int64_t before, std::int64_t after,
                                     const ScanChangeOptions& options, const RunContext& context);
/// "appeared: 412 points round (1.40, -0.88, 0.95) m, 0.10 x 0.08 x 0.21 m".
std::string ChangeText(const ScanChange& change);

/// All returns of the scans that are in the map, in its frame; the tag is the scan's place in
/// `scans`.
std::vector<TaggedPoint> PointsOfMap(const MissionMap& map);

}  // namespace foresight
