#include "hardware/link/server/item_cache.h"

#include "core/base/thread_priority.h"

namespace foresight {
namespace {

/// How soon a scan that grows is looked at again.
constexpr std::chrono::milliseconds kTick{100};

}  // namespace

ItemCache::ItemCache(ScanShelf& shelf, std::int64_t most_bytes)
    : shelf_(shelf), most_bytes_(most_bytes) {
  thread_ = std::jthread([this](const std::stop_token& stop) { Work(stop); });
}

ItemCache::~ItemCache() = default;

void ItemCache::Prepare(const std::string& scan_id, const ChunkSet& have,
                        const TransferPreferences& preferences) {
  const std::lock_guard lock(mutex_);
  if (scan_id_ != scan_id) Clear();
  scan_id_ = scan_id;
  news_ = -1;
  preferences_ = preferences;
  done_ = have;
  for (auto item = items_.begin(); item != items_.end();) {
    if (have.Has(item->first)) {
      bytes_ -= item->second.bytes;
      item = items_.erase(item);
      continue;
    }
    item->second.acknowledged.clear();
    done_.Add(item->first);
    ++item;
  }
  changed_.notify_all();
}

void ItemCache::SetPreferences(const std::string& scan_id, const TransferPreferences& preferences) {
  const std::lock_guard lock(mutex_);
  if (scan_id_ != scan_id) return;
  preferences_ = preferences;
  changed_.notify_all();
}

/// With the mutex held.
void ItemCache::Clear() {
  scan_id_.clear();
  source_.reset();
  items_.clear();
  bytes_ = 0;
}

void ItemCache::Forget(const std::string& scan_id) {
  const std::lock_guard lock(mutex_);
  if (scan_id_ == scan_id) Clear();
}

Result<SharedParts> ItemCache::Get(const ScanToSend& source, const ItemId& id) {
  std::unique_lock lock(mutex_);
  if (scan_id_ != source.scan.uuid) {
    lock.unlock();
    return EncodeParts(source, id);
  }
  changed_.wait(lock, [&] { return making_.count(id) == 0; });
  const auto found = items_.find(id);
  return found != items_.end() ? found->second.parts : Make(source, id, lock);
}

/// Makes the item without the mutex, which is held before and after.
Result<SharedParts> ItemCache::Make(const ScanToSend& source, const ItemId& id,
                                    std::unique_lock<std::mutex>& lock) {
  making_.insert(id);
  lock.unlock();
  Result<SharedParts> made = EncodeParts(source, id);
  lock.lock();
  making_.erase(id);
  changed_.notify_all();
  if (scan_id_ != source.scan.uuid) return made;
  done_.Add(id);
  if (!made) return made;
  Item item;
  for (const Chunk& chunk : **made) item.bytes += static_cast<std::int64_t>(chunk.bytes.size());
  item.parts = *made;
  if (items_.emplace(id, item).second) bytes_ += item.bytes;
  return made;
}

void ItemCache::Acknowledged(const std::string& scan_id, const ChunkId& id) {
  const std::lock_guard lock(mutex_);
  if (scan_id_ != scan_id) return;
  const auto found = items_.find(id.Item());
  if (found == items_.end()) return;
  Item& item = found->second;
  item.acknowledged.insert(id.part);
  if (item.acknowledged.size() < item.parts->size()) return;
  bytes_ -= item.bytes;
  items_.erase(found);
  changed_.notify_all();
}

std::int64_t ItemCache::Bytes() const {
  const std::lock_guard lock(mutex_);
  return bytes_;
}

/// What the scan has gained; reading it from the disk takes a while.
void ItemCache::Refresh() {
  std::string scan_id;
  const std::int64_t news = shelf_.News();
  {
    const std::lock_guard lock(mutex_);
    if (scan_id_.empty() || news == news_) return;
    scan_id = scan_id_;
  }
  const auto scan = shelf_.Snapshot(scan_id);
  const std::string health = shelf_.DeviceHealthJson(scan_id);
  const std::lock_guard lock(mutex_);
  if (scan_id != scan_id_) return;
  news_ = news;
  source_.reset();  // not begun yet, or gone: the stream says so
  if (scan) source_ = ScanToSend{**scan, health};
}

/// With the mutex held.
std::optional<ItemId> ItemCache::NextToMake() const {
  if (!source_ || bytes_ >= most_bytes_) return std::nullopt;
  ChunkSet done = done_;
  for (const ItemId& id : making_) done.Add(id);
  return NextItem(*source_, ItemsOf(*source_), done, preferences_);
}

void ItemCache::Work(const std::stop_token& stop) {
  LetOthersGoFirst();  // the sweep, and the stream that sends
  while (!stop.stop_requested()) {
    Refresh();
    std::unique_lock lock(mutex_);
    const auto next = NextToMake();
    if (!next) {
      changed_.wait_for(lock, stop, kTick, [] { return false; });
      continue;
    }
    const ScanToSend source = *source_;
    // The stream that asks for an item that cannot be made says why.
    static_cast<void>(Make(source, *next, lock));
  }
}

}  // namespace foresight
