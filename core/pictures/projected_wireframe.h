#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/fitting/valve/valve_detection.h"
#include "core/sensor/sensor_rig.h"

namespace foresight {

/// Open or closed polylines in pixels of an image.
using PixelLines = std::vector<std::vector<Eigen::Vector2d>>;

/// The template of a valve as the camera sees it at a motor angle. Segments longer than a
/// centimetre are subdivided, because the lens bends straight lines; parts the lens cannot see are
/// left out.
PixelLines ProjectValve(const ValveCandidate& valve, const SensorRig& rig, double motor_rad);

/// The template of a valve in the robot's frame, metres.
Wireframe ValveInRobot(const ValveCandidate& valve, const SensorRig& rig);

}  // namespace foresight
