#include "app/ctl/head_scan.h"

namespace foresight {

Result<std::string> ChooseScanOfHead(const HeadLink& head, const std::string& address,
                                     const std::string& wanted) {
  const LinkedScan* found = nullptr;
  const std::vector<LinkedScan> scans = head.Scans();
  for (const LinkedScan& scan : scans) {
    if (!scan.scan_id.starts_with(wanted)) continue;
    if (found != nullptr && !wanted.empty())
      return Fail(ErrorCode::kInvalidInput, "{}: '{}' begins the ids of several scans", address,
                  wanted);
    if (found == nullptr || scan.begin_utc_ns > found->begin_utc_ns) found = &scan;
  }
  if (found == nullptr)
    return Fail(ErrorCode::kInvalidInput,
                "{}: the head has no scan{}: see foresightctl fetch --list", address,
                wanted.empty() ? "" : " '" + wanted + "'");
  return found->scan_id;
}

}  // namespace foresight
