#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "hardware/link/burst/chunk_fragment.h"
#include "hardware/link/burst/datagram_socket.h"
#include "hardware/link/burst/sealed_datagram.h"

namespace foresight {

struct BurstSenderOptions {
  UdpPeer to;
  double bytes_per_s = 250e6 / 8.0;  ///< of what is on the wire
  std::size_t datagram_bytes = kMostDatagramBytes;
  /// Fails with kInvalidOptions.
  Status Check() const;
};

/// UDP, IP and Ethernet around a datagram: they count against the rate.
inline constexpr std::size_t kWireBytesAroundDatagram = 42;

/// A chunk, and the scan that it is of.
struct ChunkToBurst {
  std::uint64_t scan_tag = 0;
  std::shared_ptr<const Chunk> chunk;
};

/// Sends what a source gives, sealed, at an even rate, from a thread of its own. Nobody answers.
class BurstSender {
 public:
  /// The next chunk; null where there is none. With `wait` it comes back when there is one, or a
  /// stop is requested.
  using Source = std::function<ChunkToBurst(bool wait, const std::stop_token& stop)>;

  /// Fails with kInvalidOptions, and kDevice where there is no socket.
  static Result<std::unique_ptr<BurstSender>> Start(const BurstSenderOptions& options,
                                                    const BurstKey& key, Source source);
  BurstSender(const BurstSender&) = delete;
  BurstSender& operator=(const BurstSender&) = delete;

  std::int64_t SentBytes() const { return sent_bytes_; }

 private:
  BurstSender(const BurstSenderOptions& options, DatagramSocket socket, DatagramSealer sealer,
              Source source);
  void Work(const std::stop_token& stop);
  Status SealSome(const std::stop_token& stop);
  bool NextFragment(bool wait, const std::stop_token& stop);

  const BurstSenderOptions options_;
  const std::uint32_t stride_;
  DatagramSocket socket_;
  DatagramSealer sealer_;
  const Source source_;
  ChunkToBurst now_;
  std::uint32_t fragment_ = 0;
  std::vector<std::uint8_t> content_;
  std::vector<std::vector<std::uint8_t>> sealed_;
  std::size_t count_ = 0;
  std::size_t bytes_ = 0;  ///< on the wire, of those
  std::atomic<std::int64_t> sent_bytes_{0};
  std::jthread thread_;  ///< last: uses what is above
};

}  // namespace foresight
