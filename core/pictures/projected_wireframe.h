#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/objects/solid_part.h"
#include "core/sensor/sensor_rig.h"

namespace foresight {

/// Open or closed polylines in pixels of an image.
using PixelLines = std::vector<std::vector<Eigen::Vector2d>>;

/// Lines of base as the camera sees them at a motor angle. Segments longer than a centimetre are
/// subdivided, because the lens bends straight lines; parts the lens cannot see are left out.
PixelLines ProjectWireframe(const Wireframe& in_base, const SensorRig& rig, double motor_rad);

/// The same lines in the robot's frame, metres.
Wireframe WireframeInRobot(const Wireframe& in_base, const SensorRig& rig);

}  // namespace foresight
