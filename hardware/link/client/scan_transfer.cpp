#include "hardware/link/client/scan_transfer.h"

#include "core/base/log.h"

namespace foresight {

Result<std::unique_ptr<ScanTransfer>> ScanTransfer::Open(const std::filesystem::path& spool,
                                                         const std::string& scan_id,
                                                         const std::string& rig_yaml) {
  auto transfer = std::unique_ptr<ScanTransfer>(new ScanTransfer(scan_id, rig_yaml));
  const auto read = [&](const Chunk& chunk) {
    if (const auto taken = transfer->builder_.Take(chunk); !taken)
      LogWarning("scan {}: in its spool: {}", scan_id, taken.error().message);
  };
  FORESIGHT_TRY(transfer->spool_, SpoolFile::Open(spool, scan_id, read));
  transfer->TryRig();
  return transfer;
}

/// The rig of the station is used once the header says that it is the scan's.
void ScanTransfer::TryRig() {
  if (rig_yaml_.empty() || !builder_.header() || builder_.Have().Has({ChunkKind::kRig, 0})) return;
  if (builder_.UseRig(rig_yaml_)) return;
  mistaken_rig_ = true;
  rig_yaml_.clear();
}

ChunkSet ScanTransfer::Have() const {
  ChunkSet have = builder_.Have();
  for (const Chunk& chunk : waiting_) have.AddPart(chunk);
  if (!rig_yaml_.empty()) have.Add(ItemId{ChunkKind::kRig, 0});
  return have;
}

Result<std::vector<ChunkId>> ScanTransfer::Keep(std::vector<Chunk> chunks) {
  std::erase_if(chunks, [&](const Chunk& chunk) {
    const Status good = CheckChunk(chunk);
    if (!good) LogWarning("scan {}: {}", builder_.scan_id(), good.error().message);
    return !good;
  });
  if (!chunks.empty()) FORESIGHT_CHECK(spool_->Append(chunks));
  std::vector<ChunkId> ids;
  for (Chunk& chunk : chunks) {
    ids.push_back(chunk.id);
    waiting_bytes_ += static_cast<std::int64_t>(chunk.bytes.size());
    waiting_.push_back(std::move(chunk));
  }
  return ids;
}

bool ScanTransfer::TakeInNext() {
  const Chunk chunk = std::move(waiting_.front());
  waiting_.pop_front();
  const auto bytes = static_cast<std::int64_t>(chunk.bytes.size());
  waiting_bytes_ -= bytes;
  taken_bytes_ += bytes;
  const auto taken = builder_.Take(chunk);
  if (!taken) LogWarning("scan {}: {}", builder_.scan_id(), taken.error().message);
  if (taken && chunk.id.kind == ChunkKind::kCoarseCloud && !coarse_)
    LogInfo("scan {}: the first coarse cloud is here", builder_.scan_id());
  coarse_ = coarse_ || chunk.id.kind == ChunkKind::kCoarseCloud;
  TryRig();
  return taken.has_value();
}

}  // namespace foresight
