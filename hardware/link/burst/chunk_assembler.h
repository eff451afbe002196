#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hardware/link/burst/chunk_fragment.h"

namespace foresight {

/// Makes chunks of fragments that come in any order, some never, some again. What is known of a
/// chunk is kept when it is sent again, so a lost fragment costs that fragment. Memory is bounded:
/// the chunk that began longest ago gives way. Not for several threads at a time.
class ChunkAssembler {
 public:
  /// More than a room with 12 lossless images.
  static constexpr std::size_t kUsualBytes = std::size_t{64} << 20;

  explicit ChunkAssembler(std::size_t most_bytes = kUsualBytes) : most_bytes_(most_bytes) {}

  /// The chunk where this was its last fragment. Fails with kBadData where all of them together are
  /// not what its CRC says: they are forgotten.
  Result<std::optional<Chunk>> Take(const ChunkFragment& fragment);
  /// Of chunks that are not whole.
  std::size_t bytes() const { return bytes_; }
  std::size_t chunks() const { return open_.size(); }
  void Forget();

 private:
  using Key = std::pair<std::uint64_t, ChunkId>;
  struct Open {
    std::int32_t parts = 0;
    std::uint32_t item_crc = 0;
    std::uint32_t crc = 0;
    std::uint32_t stride = 0;
    std::string bytes;
    std::vector<bool> here;
    std::uint32_t missing = 0;
    std::uint64_t begun = 0;
  };

  static bool Fits(const Open& open, const ChunkFragment& fragment);
  static std::size_t Cost(const Open& open);
  Open& Begin(const Key& key, const ChunkFragment& fragment);
  void Remove(std::map<Key, Open>::iterator at);
  void MakeRoom(std::size_t bytes);

  std::size_t most_bytes_;
  std::map<Key, Open> open_;
  std::size_t bytes_ = 0;
  std::uint64_t begun_ = 0;
};

}  // namespace foresight
