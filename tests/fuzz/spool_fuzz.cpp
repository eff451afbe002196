// Records of a station's spool, behind its head.
#include <cstdint>
#include <string_view>
#include <vector>

#include "hardware/link/chunks/spool_file.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace foresight;
  const std::string_view records(reinterpret_cast<const char*>(bytes), size);
  std::vector<Chunk> chunks;
  const auto keep = [&](const Chunk& chunk) { chunks.push_back(chunk); };
  const std::size_t clean = ReadSpoolRecords(records, keep);
  Require(clean <= size, "no record ends behind the file");
  for (const Chunk& chunk : chunks) Require(CheckChunk(chunk).has_value(), "chunks are whole");
  const std::size_t count = chunks.size();
  Require(ReadSpoolRecords(records.substr(0, clean), keep) == clean, "the clean prefix is clean");
  Require(chunks.size() == 2 * count, "and holds the same chunks");
  return 0;
}
