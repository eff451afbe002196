#pragma once

#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <vector>

#include "hardware/link/burst/burst_pace.h"
#include "hardware/link/burst/burst_receiver.h"
#include "hardware/link/client/link_session.h"

namespace foresight {

/// The station's end of a burst path: asks the head for it, and has the chunks that come on it.
/// Safe from any thread but for what the thread of the ScanFetcher alone may call.
class BurstClient {
 public:
  struct Options {
    std::string host;  ///< of this computer, where the head sends to; empty = as the head sees us
    int port = 0;      ///< 0 = a free one
    int datagram_bytes = static_cast<int>(kMostDatagramBytes);
  };

  /// Fails with kInvalidOptions, kDevice where the port is taken.
  static Result<std::unique_ptr<BurstClient>> Listen(const Options& options);
  /// Says in the log what came.
  ~BurstClient();

  // Of the fetcher's thread alone.
  /// Asks for the chunks of a scan. Returns the id of the path's key for the scan's stream; 0 where
  /// the head sends none: Trouble() has why, and the stream carries all. Fails with kDevice where
  /// the link is lost.
  Result<std::uint32_t> Open(LinkSession& session, const std::string& scan_id, const ChunkSet& have,
                             const std::stop_token& stop);
  /// Whether datagrams come, or came less than a long blackout ago: then the stream carries only
  /// what is small.
  bool Carries() const;
  std::vector<Chunk> TakeChunks() { return receiver_->TakeChunks(); }
  /// What the station has now, and whether it is time to tell the head.
  void SetHave(const ChunkSet& have);
  bool MayTell(double now_s) const { return untold_ && pace_.MaySend(now_s); }
  /// What the head is to be told.
  std::string Tell(const ChunkSet& have, double now_s);

  BurstCounts Counts() const { return receiver_->Counts(); }
  std::string Trouble() const;

 private:
  BurstClient(const Options& options, std::unique_ptr<BurstReceiver> receiver)
      : options_(options), receiver_(std::move(receiver)) {}
  void SetTrouble(const std::string& trouble);

  const Options options_;
  const std::unique_ptr<BurstReceiver> receiver_;
  bool open_ = false;
  bool untold_ = false;
  ReturnPace pace_;
  mutable std::mutex mutex_;  ///< guards what follows
  std::string trouble_;
};

}  // namespace foresight
