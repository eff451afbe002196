#include "hardware/link/client/mission_archive.h"

#include "core/mission/complete_scan.h"

namespace foresight {

void MissionArchive::Use(std::shared_ptr<MissionFile> mission) {
  const std::lock_guard lock(mutex_);
  mission_ = std::move(mission);
}

Status MissionArchive::Keep(const Scan& whole) {
  std::shared_ptr<MissionFile> mission;
  {
    const std::lock_guard lock(mutex_);
    mission = mission_;
  }
  if (!mission) return Fail(ErrorCode::kState, "no mission file takes scans now");
  FORESIGHT_CHECK(CompleteScan(*mission, whole));
  return {};
}

}  // namespace foresight
