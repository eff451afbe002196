// PLY clouds.
#include <cstdint>
#include <string_view>

#include "core/io/read_point_cloud.h"
#include "tests/fuzz/cloud_files.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace foresight;
  const std::string_view file(reinterpret_cast<const char*>(bytes), size);
  const auto points = DecodePly(file, "fuzz.ply");
  RequirePointsOrReason(points, size);
  RequireSameTable(points, DecodePlyTable(file, "fuzz.ply"));
  return 0;
}
