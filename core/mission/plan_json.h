#pragma once

#include <string>

#include "core/base/result.h"
#include "core/sensor/scan_plan.h"

namespace foresight {

/// A scan plan as one line of JSON; numbers survive the round trip exactly.
std::string PlanToJson(const ScanPlan& plan);
/// Fails with kBadData where a member is missing, is no number or is one that no head executes
/// (ScanPlan::Check), naming `source`. `image_mode`,
/// `max_blur_px` and `passes` may be missing: a plan of an earlier version has one pass on the fly.
Result<ScanPlan> PlanFromJson(const std::string& json, const std::string& source);

}  // namespace foresight
