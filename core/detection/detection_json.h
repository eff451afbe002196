#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/detection/detection.h"

namespace foresight {

/// A detection as JSON, docs/formats.md: what a robot's planner needs (poses in base and in robot)
/// and what an operator saw (verdict, evidence, alternatives, region). Metres and radians.
std::string DetectionToJson(const Detection& detection,
                            const Rigid<frame::Robot, frame::Base>& robot_from_base);

/// The reverse; numbers survive the round trip. Poses in robot are not read, and a terrain's labels
/// are not kept: they belong to rays. Fails with kBadData, naming the member at fault.
Result<Detection> DetectionFromJson(std::string_view text);

/// The numbers of a detection's `evidence` with their names there, in the order of the names; of a
/// terrain, whose surfaces each have their own, none. NaN where one is not known.
std::vector<std::pair<std::string, double>> EvidenceNumbers(const Detection& detection);

/// A region as one line of JSON, as in a detection's `roi`.
std::string RoiToJson(const Roi& roi);
/// Bit for bit what was written. Fails with kBadData, and where CheckRoi does.
Result<Roi> RoiFromJson(std::string_view text);

}  // namespace foresight
