#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "hardware/link/chunks/chunk_source.h"
#include "hardware/link/server/head_desk.h"
#include "hardware/link/server/item_cache.h"
#include "sensor_head.grpc.pb.h"

namespace foresight {

/// One scan on its way to one station: sends what the station does not have in the order of its
/// use, and never more unacknowledged bytes than the station gave credit for. That a station has
/// all of it counts where an operator says so: an observer's copy does not let the head delete its
/// own.
class TransferStream {
 public:
  using Stream = grpc::ServerReaderWriter<link::Chunk, link::TransferRequest>;

  TransferStream(ScanShelf& shelf, ItemCache& cache, const BurstDesk& bursts, HeadDesk::Peer peer,
                 grpc::ServerContext& context, Stream& stream, std::function<bool()> still_good)
      : shelf_(shelf),
        cache_(cache),
        bursts_(bursts),
        peer_(std::move(peer)),
        context_(context),
        stream_(stream),
        still_good_(std::move(still_good)) {}

  /// Until the station has all of the scan, is gone, or `closing`.
  grpc::Status Run(const std::atomic<bool>& closing);

 private:
  grpc::Status Begin(const link::TransferStart& start);
  void Read();
  void TakePreferences(const link::TransferPreferences& preferences);
  void TakeAcknowledge(const link::Acknowledge& acknowledge);
  grpc::Status Send(const std::atomic<bool>& closing);
  Status Refresh();
  bool MaySend();
  bool Write(link::Chunk message);
  bool Flush();
  grpc::Status Confirm();

  ScanShelf& shelf_;
  ItemCache& cache_;
  const BurstDesk& bursts_;
  const HeadDesk::Peer peer_;
  grpc::ServerContext& context_;
  Stream& stream_;
  const std::function<bool()> still_good_;  ///< asked at each message of the station
  std::string scan_id_;
  std::optional<ChunkSource> source_;  ///< of the sending thread alone
  std::int64_t news_ = -1;             ///< of the shelf, that source_ has
  std::optional<link::Chunk> held_;    ///< until the next one is there, of the sending thread alone
  std::shared_ptr<BurstSession> burst_;  ///< carries the scan too; null = none

  std::mutex mutex_;  ///< guards what follows
  std::condition_variable wake_;
  bool gone_ = false;
  bool paused_ = false;
  bool answered_ = false;  ///< the station has had a chunk of this stream
  bool confirmed_ = false;
  std::int64_t credit_ = 0;
  std::int64_t in_flight_ = 0;  ///< bytes that were sent and not acknowledged
  std::map<ChunkId, std::int64_t> sent_;
  std::optional<TransferPreferences> preferences_;  ///< that came and were not taken over yet
  std::optional<ChunkSet> have_;                    ///< as preferences_
};

}  // namespace foresight
