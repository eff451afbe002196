// Packed lines of an imported cloud in a mission file.
#include <cstdint>
#include <string>

#include "core/mission/given_codec.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace foresight;
  if (size < 4) return 0;
  PackedGivenLine packed;
  packed.parts = bytes[0] % 6 - 1;
  packed.beams = bytes[1] + 256 * bytes[2] - 16;
  packed.bytes.assign(reinterpret_cast<const char*>(bytes) + 4, size - 4);
  const std::int64_t line = bytes[3] % 8 - 1;
  GivenCloudBuilder builder;
  if (!builder.Add(line, packed)) return 0;
  const GivenCloud cloud = builder.Take();
  Require(cloud.lines == line + 1 && cloud.beams == packed.beams, "lines up to this one");
  const std::size_t cells = cloud.Index(cloud.lines, 0);
  Require(
      cloud.points.size() == cells && cloud.origins.size() == static_cast<std::size_t>(cloud.lines),
      "a point for each beam, an origin for each line");
  const auto again = PackGivenLine(cloud, static_cast<int>(line));
  Require(again.has_value(), "what was unpacked can be packed");
  GivenCloudBuilder same;
  Require(same.Add(line, *again).has_value() && same.Take() == cloud, "packing loses nothing");
  return 0;
}
