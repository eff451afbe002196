#include "hardware/link/client/early_scan.h"

namespace foresight {

std::shared_ptr<const EarlyScan> EarlyScanOf(const ScanBuilder& builder) {
  Result<PartialScan> partial = builder.Partial();
  if (!partial) return nullptr;
  EarlyScan early;
  early.lines = static_cast<int>(partial->scan.lines.size());
  if (const auto of = partial->progress.of_lines) early.of_lines = static_cast<int>(*of);
  if (auto cloud = builder.Cloud(); cloud && cloud->points.lines > early.lines) {
    early.lines = cloud->points.lines;
    early.cloud = std::make_shared<const RegisteredScan>(std::move(cloud->points));
    early.cloud_seqs = std::move(cloud->seqs);
  }
  const Delivered& told = builder.delivered();
  if (early.lines <= static_cast<int>(told.lines) && partial->scan.frames.size() <= told.frames)
    return nullptr;
  partial->scan.state = ScanState::kRunning;
  early.scan = std::make_shared<const Scan>(std::move(partial->scan));
  return std::make_shared<const EarlyScan>(std::move(early));
}

}  // namespace foresight
