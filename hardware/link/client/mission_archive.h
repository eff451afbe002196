#pragma once

#include <memory>
#include <mutex>

#include "core/mission/mission_file.h"
#include "hardware/link/client/scan_archive.h"

namespace foresight {

/// Keeps whole scans in the mission that is recorded into. Safe from any thread.
class MissionArchive final : public ScanArchive {
 public:
  /// From now on; nullptr = there is none, and scans wait in the spool.
  void Use(std::shared_ptr<MissionFile> mission);
  Status Keep(const Scan& whole) override;

 private:
  std::mutex mutex_;
  std::shared_ptr<MissionFile> mission_;
};

}  // namespace foresight
