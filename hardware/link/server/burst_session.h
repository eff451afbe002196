#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "hardware/link/burst/burst_carousel.h"
#include "hardware/link/burst/burst_sender.h"
#include "hardware/link/server/scan_shelf.h"

namespace foresight {

/// The head's end of one burst path: sends the scan of the station's stream in a carousel, until
/// the station has all of it, or its stream is gone for a while. Safe from any thread.
class BurstSession {
 public:
  /// After the station's stream broke: a thin path takes 4 s to connect anew, and an attempt may
  /// last 20 s.
  static constexpr double kLinger_s = 25.0;

  /// `shelf` outlives it. Fails as BurstSender::Start does.
  static Result<std::shared_ptr<BurstSession>> Open(ScanShelf& shelf, const std::string& owner,
                                                    const BurstSenderOptions& options,
                                                    double linger_s = kLinger_s);
  BurstSession(const BurstSession&) = delete;
  BurstSession& operator=(const BurstSession&) = delete;

  const BurstKey& key() const { return key_; }
  const std::string& owner() const { return owner_; }
  /// Nothing is sent any more, and nothing will be.
  bool Over() const;

  /// A stream of the scan began; `have` is what its station said that it has.
  void Begin(const ScanToSend& source, const ChunkSet& have);
  void SetHave(const ChunkSet& have);
  void SetPreferences(const TransferPreferences& preferences, bool paused);
  /// The stream broke, or the station has all.
  void StreamGone();
  void End();

  std::int64_t SentBytes() const { return sender_->SentBytes(); }

 private:
  BurstSession(ScanShelf& shelf, const std::string& owner, const BurstKey& key, double linger_s)
      : shelf_(shelf), owner_(owner), key_(key), linger_s_(linger_s) {}
  bool OverNow() const;
  ChunkToBurst Next(bool wait, const std::stop_token& stop);
  void Encode(const std::stop_token& stop);
  bool EncodeOne();
  void Refresh();

  ScanShelf& shelf_;
  const std::string owner_;
  const BurstKey key_;
  const double linger_s_;
  mutable std::mutex mutex_;  ///< guards what follows
  std::condition_variable_any wake_;
  std::optional<BurstCarousel> carousel_;
  std::uint64_t scan_tag_ = 0;
  std::chrono::steady_clock::time_point round_began_;
  bool paused_ = false;
  bool ended_ = false;
  bool attended_ = false;  ///< a stream is there
  std::chrono::steady_clock::time_point left_ = std::chrono::steady_clock::now();
  std::int64_t news_ = -1;  ///< of the encoding thread alone
  std::unique_ptr<BurstSender> sender_;
  std::jthread encoder_;  ///< last: uses what is above
};

}  // namespace foresight
