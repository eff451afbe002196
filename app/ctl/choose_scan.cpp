#include "app/ctl/choose_scan.h"

namespace foresight {

Result<std::int64_t> ChooseScan(const MissionFile& mission, std::int64_t wanted) {
  FORESIGHT_TRY(const std::vector<ScanSummary> scans, mission.ListScans());
  if (scans.empty())
    return Fail(ErrorCode::kInvalidInput, "{}: no scan in this mission", mission.path().string());
  if (wanted == 0) return scans.back().id;
  for (const ScanSummary& scan : scans)
    if (scan.id == wanted) return wanted;
  return Fail(ErrorCode::kInvalidInput, "{}: no scan {}; there are {} to {}",
              mission.path().string(), wanted, scans.front().id, scans.back().id);
}

}  // namespace foresight
