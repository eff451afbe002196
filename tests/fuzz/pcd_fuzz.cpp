// PCD clouds, compressed ones too.
#include <cstdint>
#include <string_view>

#include "core/io/read_point_cloud.h"
#include "tests/fuzz/cloud_files.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace foresight;
  // LZF expands at most 132 times.
  const std::string_view file(reinterpret_cast<const char*>(bytes), size);
  const auto points = DecodePcd(file, "fuzz.pcd");
  RequirePointsOrReason(points, 132 * size);
  RequireSameTable(points, DecodePcdTable(file, "fuzz.pcd"));
  return 0;
}
