#pragma once

#include <memory>
#include <string>

#include "core/base/run_context.h"
#include "core/mission/mission_file.h"
#include "hardware/api/sensor_head.h"

namespace foresight {

/// A scan that is in a mission file.
struct FlownScan {
  std::int64_t id = 0;     ///< in the mission
  double seconds = 0.0;    ///< from the way to its start to the last picture
  double cpu_share = 0.0;  ///< of one core, by this process meanwhile; may exceed 1
};

/// Homes the head, flies the plan and records it. Cancelling aborts the scan, which is kept. Fails
/// with kDevice when the head ends in a fault; what it has of the scan is kept then, too.
Result<FlownScan> FlyScan(SensorHead& head, const ScanPlan& plan,
                          std::shared_ptr<MissionFile> mission, const RunContext& context);

/// Opens the mission file for more, or makes it.
Result<std::shared_ptr<MissionFile>> OpenOrCreateMission(const std::string& path);

}  // namespace foresight
