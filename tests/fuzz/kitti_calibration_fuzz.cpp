// KITTI's calibration files.
#include <cstdint>
#include <string_view>

#include "core/calibration/kitti_calibration.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace foresight;
  const std::string_view text(reinterpret_cast<const char*>(bytes), size);
  const auto camera = KittiCameraFrom(text, 2, "fuzz.txt");
  if (!camera) {
    Require(camera.error().code == ErrorCode::kBadData, "damaged text is bad data");
    Require(camera.error().message.starts_with("fuzz.txt: "), "an error names the file");
    return 0;
  }
  Require(camera->camera.fx > 1.0 && camera->camera_from_velodyne.translation().allFinite(),
          "a camera is one");
  return 0;
}
