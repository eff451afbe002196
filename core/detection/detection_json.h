#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/fitting/valve/valve_detection.h"

namespace foresight {

/// A detection as JSON, docs/formats.md: what a robot's planner needs (the pose in base and in
/// robot) and what an operator saw (verdict, evidence, rivals, region). Metres and radians.
std::string DetectionToJson(const ValveDetection& detection,
                            const Rigid<frame::Robot, frame::Base>& robot_from_base);

/// The reverse; numbers survive the round trip, the pose in robot is not read. Fails with kBadData,
/// naming the member at fault.
Result<ValveDetection> ValveDetectionFromJson(std::string_view text);

}  // namespace foresight
