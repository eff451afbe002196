#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <vector>

#include "core/detection/detection.h"
#include "core/mapping/mission_map.h"
#include "core/measure/measurement.h"
#include "core/measure/pick_point.h"

namespace foresight {

/// As PickReturn among the returns of all scans that are in the map, whatever of them is drawn.
/// `click` looks at the map's frame; the answer is in it, and knows its scan and that scan's
/// place's sigma. `pyramid` holds PointsOfMap(map). O(points within reach of the click, and those
/// of one scan).
std::optional<MeasuredPoint> PickInMap(const MissionMap& map, const PointPyramid& pyramid,
                                       const CloudClick& click);

/// The returns of all scans around a place, in map. O(points found).
std::vector<Eigen::Vector3d> ReturnsWithin(const PointPyramid& pyramid,
                                           const Eigen::Vector3d& centre, double radius_m);

/// Where the head stood, in map, at that scan of the map which stood nearest to a place.
Eigen::Vector3d NearestStandpoint(const MissionMap& map, const Eigen::Vector3d& place);

/// FindGround in the scan that a point of the map was measured in, in map. `terrains` are of that
/// scan. Fails as FindGround, and with kInvalidInput where the map does not hold the scan.
Result<MeasuredPlane> FindGroundInMap(const MissionMap& map, const MeasuredPoint& point,
                                      std::span<const TerrainDetection* const> terrains);

/// Whether the points of a measurement lie in this map where they lay when they were measured: each
/// return within a millimetre. A map that is made again from other odometry may differ.
bool LiesInMap(const MissionMap& map, const Measurement& measurement);

}  // namespace foresight
