// Cameras of other programs, in each of their formats.
#include <cmath>
#include <cstdint>

#include "core/calibration/camera_formats.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace foresight;
  const std::string text(reinterpret_cast<const char*>(bytes), size);
  for (const CameraFormat format :
       {CameraFormat::kOpenCv, CameraFormat::kRos, CameraFormat::kKalibr, CameraFormat::kColmap}) {
    const auto camera = ImportCamera(text, format, "fuzz");
    if (!camera) {
      Require(!camera.error().message.empty(), "an error has a message");
      continue;
    }
    Require(camera->Check().has_value(), "a camera that was accepted is usable");
    (void)camera->Project({0.1, 0.2, 1.0});
    (void)camera->Unproject({0.0, 0.0});
  }
  return 0;
}
