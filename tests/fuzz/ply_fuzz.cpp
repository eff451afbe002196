// PLY clouds.
#include <cstdint>
#include <string_view>

#include "core/io/read_point_cloud.h"
#include "tests/fuzz/cloud_files.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace foresight;
  RequirePointsOrReason(DecodePly({reinterpret_cast<const char*>(bytes), size}, "fuzz.ply"), size);
  return 0;
}
