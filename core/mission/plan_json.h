#pragma once

#include <string>

#include "core/base/result.h"
#include "core/sensor/scan_plan.h"

namespace foresight {

/// A scan plan as one line of JSON; numbers survive the round trip exactly.
std::string PlanToJson(const ScanPlan& plan);
/// Fails with kBadData where a member is missing or is no number, naming `source`.
Result<ScanPlan> PlanFromJson(const std::string& json, const std::string& source);

}  // namespace foresight
