#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "hardware/link/chunks/chunk_source.h"
#include "hardware/link/server/scan_shelf.h"

namespace foresight {

/// Makes the items of the scan that a station wants before its stream asks for them, and keeps them
/// until the station has them: in a blackout there is time for that, in a window of a second there
/// is none. Safe from any thread.
class ItemCache {
 public:
  /// Two windows of a second at 300 Mbit/s.
  static constexpr std::int64_t kUsualBytes = std::int64_t{80} << 20;

  /// `most_bytes` of items are kept; the shelf outlives this. `encode` is for tests.
  explicit ItemCache(ScanShelf& shelf, std::int64_t most_bytes = kUsualBytes,
                     ChunkSource::PartsOf encode = EncodeParts);
  ~ItemCache();
  ItemCache(const ItemCache&) = delete;
  ItemCache& operator=(const ItemCache&) = delete;

  /// A station wants this scan next, and has this of it. Items of other scans are let go of.
  void Prepare(const std::string& scan_id, const ChunkSet& have,
               const TransferPreferences& preferences);
  /// The station wants something else of it.
  void SetPreferences(const std::string& scan_id, const TransferPreferences& preferences);
  /// The item's parts: those that are here, or made now; where they are being made, this waits a
  /// little for them. Fails as EncodeParts does.
  Result<SharedParts> Get(const ScanToSend& source, const ItemId& id);
  /// The station has this part.
  void Acknowledged(const std::string& scan_id, const ChunkId& id);

  /// A station has all of the scan.
  void Forget(const std::string& scan_id);

  /// Of the items that are kept.
  std::int64_t Bytes() const;

 private:
  struct Item {
    SharedParts parts;
    std::set<int> acknowledged;
    std::int64_t bytes = 0;
  };

  void Work(const std::stop_token& stop);
  void Help(const std::stop_token& stop);
  bool MayHelp() const;
  bool MakeNext();
  void Refresh();
  std::optional<ItemId> NextToMake() const;
  Result<SharedParts> Make(const ScanToSend& source, const ItemId& id,
                           std::unique_lock<std::mutex>& lock);
  void Clear();

  ScanShelf& shelf_;
  const std::int64_t most_bytes_;
  const ChunkSource::PartsOf encode_;

  mutable std::mutex mutex_;  ///< guards what follows
  std::condition_variable_any changed_;
  std::string scan_id_;  ///< empty = none is wanted
  std::optional<ScanToSend> source_;
  std::int64_t news_ = -1;  ///< of the shelf, that source_ has
  ChunkSet done_;           ///< what the station has, and what was made
  TransferPreferences preferences_;
  std::map<ItemId, Item> items_;
  std::int64_t bytes_ = 0;
  std::set<ItemId> making_;                             ///< by the makers and by streams
  std::chrono::steady_clock::time_point acknowledged_;  ///< the last part that was

  // Last: they use the others.
  std::jthread maker_;   ///< others of this computer go first
  std::jthread helper_;  ///< as urgent as others, while nothing urgent is done here
};

}  // namespace foresight
