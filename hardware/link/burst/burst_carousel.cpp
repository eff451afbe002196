#include "hardware/link/burst/burst_carousel.h"

#include "core/base/contract.h"

namespace foresight {
namespace {

std::size_t BytesOf(const std::vector<Chunk>& parts) {
  std::size_t bytes = 0;
  for (const Chunk& part : parts) bytes += part.bytes.size() + sizeof part;
  return bytes;
}

}  // namespace

BurstCarousel::BurstCarousel(ScanToSend source, ChunkSet have, std::size_t most_bytes)
    : source_(std::move(source)), counts_(ItemsOf(source_)), most_bytes_(most_bytes) {
  SetHave(std::move(have));
  BeginRound();
}

void BurstCarousel::Update(ScanToSend source) {
  FORESIGHT_EXPECTS(source.scan.uuid == source_.scan.uuid, "a carousel is of one scan");
  source_ = std::move(source);
  counts_ = ItemsOf(source_);
}

void BurstCarousel::SetHave(ChunkSet have) {
  have_ = std::move(have);
  round_.Add(have_);
  for (auto at = encoded_.begin(); at != encoded_.end();) {
    if (have_.Has(at->first)) {
      bytes_ -= BytesOf(*at->second);
      at = encoded_.erase(at);
    } else {
      ++at;
    }
  }
}

std::optional<ItemId> BurstCarousel::NextToEncode() const {
  if (bytes_ >= most_bytes_) return std::nullopt;
  ChunkSet done = have_;
  done.Add(left_out_);
  for (const auto& [id, parts] : encoded_) done.Add(id);
  return NextItem(source_, counts_, done, preferences_);
}

void BurstCarousel::Add(const ItemId& id, std::vector<Chunk> parts) {
  if (have_.Has(id) || encoded_.count(id) != 0) return;
  bytes_ += BytesOf(parts);
  encoded_[id] = std::make_shared<const std::vector<Chunk>>(std::move(parts));
}

std::shared_ptr<const Chunk> BurstCarousel::Next() {
  for (;;) {
    while (open_ && part_ < open_->size()) {
      const Chunk& chunk = (*open_)[part_++];
      if (!have_.HasPart(chunk.id, chunk.item_crc)) return {open_, &chunk};
    }
    open_.reset();
    const auto id = NextItem(source_, counts_, round_, preferences_);
    if (!id) return nullptr;
    round_.Add(*id);
    const auto found = encoded_.find(*id);
    if (found == encoded_.end()) continue;
    open_ = found->second;
    part_ = 0;
  }
}

void BurstCarousel::BeginRound() {
  round_ = have_;
  round_.Add(left_out_);
}

}  // namespace foresight
