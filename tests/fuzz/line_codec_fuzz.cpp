// Packed lidar lines of a mission file.
#include <cstdint>
#include <string>

#include "core/mission/line_codec.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace foresight;
  if (size < 3) return 0;
  PackedLine packed;
  packed.has_intensity = (bytes[0] & 1) != 0;
  packed.beams = bytes[1] + 256 * bytes[2] - 16;
  packed.bytes.assign(reinterpret_cast<const char*>(bytes) + 3, size - 3);
  LidarLine line;
  if (!UnpackLine(packed, line)) return 0;
  Require(line.range_mm.size() == static_cast<std::size_t>(packed.beams), "a range for each beam");
  const auto again = PackLine(line);
  Require(again.has_value(), "what was unpacked can be packed");
  LidarLine same;
  Require(UnpackLine(*again, same).has_value() && same.range_mm == line.range_mm &&
              same.intensity == line.intensity,
          "packing loses nothing");
  return 0;
}
