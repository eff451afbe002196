#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/registration/register_scan.h"
#include "core/sensor/sensor_rig.h"

namespace foresight {

/// The scan's returns in robot, metres.
std::vector<Eigen::Vector3f> ReturnsInRobot(const RegisteredScan& cloud, const SensorRig& rig);

}  // namespace foresight
