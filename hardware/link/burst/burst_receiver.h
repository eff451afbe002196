#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "hardware/link/burst/chunk_assembler.h"
#include "hardware/link/burst/datagram_socket.h"
#include "hardware/link/burst/sealed_datagram.h"
#include "hardware/link/chunks/chunk_set.h"
#include "hardware/net/wake_up.h"

namespace foresight {

/// What came on a burst path since the program started.
struct BurstCounts {
  std::int64_t datagrams = 0;  ///< that were good
  std::int64_t bytes = 0;      ///< of those
  std::int64_t chunks = 0;     ///< that became whole
  std::int64_t foreign = 0;    ///< refused: no datagram of ours, or another key's
  std::int64_t replayed = 0;   ///< refused
  std::int64_t forged = 0;     ///< refused: not sealed by the head, or not what its CRC says
  std::int64_t Refused() const { return foreign + replayed + forged; }
  bool operator==(const BurstCounts&) const = default;
};

/// The reader of a burst path: datagrams in, chunks out. No threads, no sockets: what BurstReceiver
/// does with each datagram. Whatever the bytes are, memory stays within its bounds.
class BurstReader {
 public:
  /// Of chunks that wait to be taken; more are dropped, and come again.
  static constexpr std::size_t kMostWaitingBytes = std::size_t{64} << 20;

  /// Datagrams of this key and scan are taken from now on, and no others. Fails with kDevice.
  Status Expect(const BurstKey& key, const std::string& scan_id, const ChunkSet& have);
  /// What is kept of the scan: those chunks are not made again.
  void SetHave(const ChunkSet& have);
  void Take(std::span<const std::uint8_t> datagram);
  /// The chunks that became whole since the last call.
  std::vector<Chunk> TakeChunks();
  const BurstCounts& counts() const { return counts_; }

 private:
  void TakeContent(std::span<const std::uint8_t> content);

  std::optional<DatagramOpener> opener_;
  std::uint64_t scan_tag_ = 0;
  ChunkSet here_;  ///< kept, or waiting to be taken
  ChunkAssembler assembler_;
  std::vector<Chunk> waiting_;
  std::size_t waiting_bytes_ = 0;
  std::vector<std::uint8_t> content_;
  BurstCounts counts_;
};

/// A station's end of a burst path: a BurstReader on a port, with a thread of its own. Safe from
/// any thread.
class BurstReceiver {
 public:
  /// Fails with kInvalidOptions, kDevice where the port is taken.
  static Result<std::unique_ptr<BurstReceiver>> Listen(const TcpAddress& address);
  ~BurstReceiver();
  BurstReceiver(const BurstReceiver&) = delete;
  BurstReceiver& operator=(const BurstReceiver&) = delete;

  const TcpAddress& address() const { return socket_.address(); }
  Status Expect(const BurstKey& key, const std::string& scan_id, const ChunkSet& have);
  void SetHave(const ChunkSet& have);
  std::vector<Chunk> TakeChunks();
  BurstCounts Counts() const;
  /// Since the last good datagram, or Expect.
  double SilenceSeconds() const;

 private:
  explicit BurstReceiver(DatagramSocket socket);
  void Work(const std::stop_token& stop);

  DatagramSocket socket_;
  const WakeUp wake_;
  mutable std::mutex mutex_;  ///< guards what follows
  BurstReader reader_;
  std::chrono::steady_clock::time_point heard_ = std::chrono::steady_clock::now();
  std::jthread thread_;  ///< last: uses what is above
};

}  // namespace foresight
