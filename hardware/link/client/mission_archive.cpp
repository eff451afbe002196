#include "hardware/link/client/mission_archive.h"

#include <chrono>
#include <thread>

#include "core/mission/complete_scan.h"

namespace foresight {
namespace {

constexpr std::chrono::milliseconds kCancelLook{20};
constexpr int kLooks = 500;  ///< ten seconds; then it is tried again later

bool IsBeingWritten(const MissionFile& mission, const std::string& uuid) {
  const auto id = mission.FindScan(uuid);
  if (!id || !*id) return false;
  const auto summary = mission.Summary(**id);
  return summary && summary->state == ScanState::kRunning;
}

}  // namespace

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
  // The sink of the scan may have more of it on the way to the same file.
  for (int i = 0; i < kLooks && IsBeingWritten(*mission, whole.uuid); ++i)
    std::this_thread::sleep_for(kCancelLook);
  FORESIGHT_CHECK(CompleteScan(*mission, whole));
  return {};
}

}  // namespace foresight
