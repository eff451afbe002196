// Datagrams of a burst path. The first byte says whether what follows comes as it is, or sealed
// with the path's key, as from a head gone mad; then each datagram behind its length (u16,
// little-endian).
#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "hardware/link/burst/burst_receiver.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace foresight;
  if (size == 0) return 0;
  const bool sealed = (bytes[0] & 1) != 0;
  const BurstKey key = BurstKey::FromBytes(7, std::string(BurstKey::kSecretBytes, 'k')).value();
  DatagramSealer sealer = DatagramSealer::Make(key).value();
  BurstReader reader;
  Require(reader.Expect(key, "scan", {}).has_value(), "a key is taken");
  std::span<const std::uint8_t> left(bytes + 1, size - 1);
  std::vector<std::uint8_t> datagram;
  std::int64_t taken = 0;
  while (left.size() >= 2) {
    const std::size_t length = std::min<std::size_t>(left[0] | left[1] << 8, left.size() - 2);
    const auto content = left.subspan(2, length);
    if (sealed) {
      Require(sealer.Seal(content, datagram).has_value(), "everything can be sealed");
      reader.Take(datagram);
    } else {
      reader.Take(content);
    }
    ++taken;
    left = left.subspan(2 + length);
  }
  const BurstCounts& counts = reader.counts();
  Require(counts.datagrams <= taken && counts.chunks <= counts.datagrams, "each is counted once");
  if (!sealed) Require(counts.datagrams == 0, "nobody seals without the key");
  for (const Chunk& chunk : reader.TakeChunks())
    Require(CheckChunk(chunk).has_value(), "chunks are whole");
  return 0;
}
