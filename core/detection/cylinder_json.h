#pragma once

#include <string>

#include "core/fitting/cylinder/cylinder_detection.h"

namespace foresight {

/// A cylinder as JSON, docs/formats.md: axis in base and in robot, size, evidence, verdict, region.
/// Metres and radians. `probability` is null: none was calibrated.
std::string CylinderToJson(const CylinderDetection& cylinder,
                           const Rigid<frame::Robot, frame::Base>& robot_from_base);

}  // namespace foresight
