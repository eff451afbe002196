#pragma once

#include <string>

#include "app/common/exit_code.h"
#include "core/base/run_context.h"
#include "hardware/api/sensor_head.h"

namespace foresight {

/// "6.0 s, 240 lines, 3.2 % of the pixels measured, ...".
std::string ToText(const ScanPrediction& prediction);

/// What scanning programs do: says on standard error what is to come, executes the plan, adds the
/// scan to the mission file and prints what it became. kNegative when the scan is not complete.
Result<ExitCode> RecordScan(SensorHead& head, const ScanPlan& plan, const std::string& mission_file,
                            bool json, const RunContext& context);

}  // namespace foresight
