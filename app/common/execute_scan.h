#pragma once

#include <memory>
#include <string>

#include "core/base/run_context.h"
#include "core/mission/mission_file.h"
#include "hardware/api/sensor_head.h"

namespace foresight {

/// A scan that is in a mission file.
struct ExecutedScan {
  std::int64_t id = 0;        ///< in the mission
  double seconds = 0.0;       ///< from the way to its start to the last image
  double cpu_fraction = 0.0;  ///< of one core, by this process meanwhile; may exceed 1
};

/// Homes the head, executes the plan and records it. Cancelling aborts the scan, which is kept.
/// Fails with kDevice when the head ends in a fault; what it has of the scan is kept then, too.
Result<ExecutedScan> ExecuteScan(SensorHead& head, const ScanPlan& plan,
                                 std::shared_ptr<MissionFile> mission, const RunContext& context);

/// Opens the mission file for more, or makes it. What a program that found its disk full left
/// behind, an empty file or one without a single table, is replaced.
Result<std::shared_ptr<MissionFile>> OpenOrCreateMission(const std::string& path);

/// While it lives, the file at `path` is this run's to remove: one that was not there before and
/// holds no scan at the end is.
class RemoveUnlessUsed {
 public:
  explicit RemoveUnlessUsed(std::string path);
  ~RemoveUnlessUsed();
  RemoveUnlessUsed(const RemoveUnlessUsed&) = delete;
  RemoveUnlessUsed& operator=(const RemoveUnlessUsed&) = delete;

 private:
  const std::string path_;
  const bool was_there_;
};

}  // namespace foresight
