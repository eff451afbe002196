#include "hardware/link/server/item_cache.h"

#include <algorithm>

#include "core/base/thread_priority.h"

namespace foresight {
namespace {

/// How soon a scan that grows is looked at again.
constexpr std::chrono::milliseconds kCacheTick{100};
/// An item takes some 55 ms to make where the maker has a core.
constexpr std::chrono::milliseconds kPatience{60};
/// And the end 600 ms, for the digest of a scan of 400 MB.
constexpr std::chrono::milliseconds kPatienceForTheEnd{600};
/// After this time without a word of the station there is a blackout.
constexpr std::chrono::milliseconds kQuiet{100};
/// A quarter of a second at 300 Mbit/s: who sends will soon have to wait.
constexpr std::int64_t kFewBytes = std::int64_t{9} << 20;

bool IsRecording(const ScanShelf& shelf) {
  const std::vector<ShelvedScan> scans = shelf.List();
  return std::any_of(scans.begin(), scans.end(),
                     [](const ShelvedScan& scan) { return scan.state == ScanState::kRunning; });
}

}  // namespace

ItemCache::ItemCache(ScanShelf& shelf, std::int64_t most_bytes, ChunkSource::PartsOf encode)
    : shelf_(shelf), most_bytes_(most_bytes), encode_(std::move(encode)) {
  maker_ = std::jthread([this](const std::stop_token& stop) { Work(stop); });
  helper_ = std::jthread([this](const std::stop_token& stop) { Help(stop); });
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
    return encode_(source, id);
  }
  // The maker may not get a core for a long time, where this computer does other work too.
  changed_.wait_for(lock, id.kind == ChunkKind::kEnd ? kPatienceForTheEnd : kPatience,
                    [&] { return making_.count(id) == 0; });
  const auto found = items_.find(id);
  return found != items_.end() ? found->second.parts : Make(source, id, lock);
}

/// Makes the item without the mutex, which is held before and after.
Result<SharedParts> ItemCache::Make(const ScanToSend& source, const ItemId& id,
                                    std::unique_lock<std::mutex>& lock) {
  making_.insert(id);
  lock.unlock();
  Result<SharedParts> made = encode_(source, id);
  lock.lock();
  making_.erase(id);
  changed_.notify_all();
  // Somebody else was faster, and the station may have the item already.
  if (scan_id_ != source.scan.uuid || done_.Has(id)) return made;
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
  acknowledged_ = std::chrono::steady_clock::now();
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

/// Whether there was something to make.
bool ItemCache::MakeNext() {
  std::unique_lock lock(mutex_);
  const auto next = NextToMake();
  if (!next) return false;
  const ScanToSend source = *source_;
  // The stream that asks for an item that cannot be made says why.
  static_cast<void>(Make(source, *next, lock));
  return true;
}

void ItemCache::Work(const std::stop_token& stop) {
  LetOthersGoFirst();  // the sweep, and the stream that sends
  while (!stop.stop_requested()) {
    Refresh();
    if (MakeNext()) continue;
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, stop, kCacheTick, [] { return false; });
  }
}

/// With the mutex held. In a window the stream has the cores, unless it is about to run dry.
bool ItemCache::MayHelp() const {
  return source_ &&
         (bytes_ < kFewBytes || std::chrono::steady_clock::now() - acknowledged_ > kQuiet);
}

/// Where others of this computer have more to do than it has cores, the maker alone would bring
/// next to nothing between two windows. A sweep is not disturbed.
void ItemCache::Help(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    bool may = false;
    {
      std::unique_lock lock(mutex_);
      may = MayHelp();
    }
    if (may && !IsRecording(shelf_) && MakeNext()) continue;
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, stop, kCacheTick, [] { return false; });
  }
}

}  // namespace foresight
