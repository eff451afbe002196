#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/mapping/align_clouds.h"
#include "core/registration/returns_in_robot.h"
#include "core/sensor/sensor_rig.h"

namespace foresight {

/// A scan that a map is made of. Nothing is owned.
struct ScanForMap {
  const RegisteredScan& cloud;
  const SensorRig& rig;
  /// Where the robot believes it stood, in any frame that all scans share; none = not known.
  std::optional<Rigid<frame::Map, frame::Robot>> odometry;
};

/// Where a scan lies in the map.
struct MapPlace {
  Rigid<frame::Map, frame::Robot> map_from_robot;
  /// None = the first scan, or one that could not be aligned.
  std::optional<CloudAlignment> alignment;
  /// Why it could not be aligned; it is not part of the map then. Empty = it could.
  std::string failure;
  bool InMap() const { return failure.empty(); }
};

/// Brings scans together, one after the other: each is aligned (AlignClouds) to all before it that
/// are in the map, from where odometry says, seen from the last one that was aligned; without
/// odometry from where that one stood. The first scan is the map's frame. One place a scan, in
/// their order. Fails with kInvalidInput without a scan, kTooFewPoints where the first scan has no
/// return, kInvalidOptions and kCancelled; a later scan that cannot be aligned only says so.
Result<std::vector<MapPlace>> PlaceScans(const std::vector<ScanForMap>& scans,
                                         const AlignCloudsOptions& options,
                                         const RunContext& context);

}  // namespace foresight
