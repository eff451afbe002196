#include "hardware/gige/gige_camera_options.h"

#include <cmath>

namespace foresight {
namespace {

Status NotNegative(const char* name, double value) {
  if (value >= 0.0 && std::isfinite(value)) return {};
  return Fail(ErrorCode::kInvalidOptions, "camera: {} must not be negative, is {}", name, value);
}

Status AtLeastOne(const char* name, int value) {
  if (value >= 1) return {};
  return Fail(ErrorCode::kInvalidOptions, "camera: {} must be at least 1, is {}", name, value);
}

}  // namespace

Status GigeCameraOptions::Check() const {
  if (address.empty()) return Fail(ErrorCode::kInvalidOptions, "camera: address is empty");
  if (packet_bytes != 0 && (packet_bytes < 576 || packet_bytes > 16384))
    return Fail(ErrorCode::kInvalidOptions, "camera: packet_bytes must be 576 to 16384, is {}",
                packet_bytes);
  if (!std::isfinite(stamp_offset_s))
    return Fail(ErrorCode::kInvalidOptions, "camera: stamp_offset_s must be finite, is {}",
                stamp_offset_s);
  FORESIGHT_CHECK(NotNegative("frame_timeout_s", frame_timeout_s));
  FORESIGHT_CHECK(NotNegative("connect_timeout_s", connect_timeout_s));
  FORESIGHT_CHECK(NotNegative("configure_timeout_s", configure_timeout_s));
  FORESIGHT_CHECK(NotNegative("frame_retention_s", frame_retention_s));
  FORESIGHT_CHECK(NotNegative("packet_delay_s", packet_delay_s));
  FORESIGHT_CHECK(AtLeastOne("buffers", buffers));
  FORESIGHT_CHECK(AtLeastOne("clock_readings", clock_readings));
  FORESIGHT_CHECK(NotNegative("resync_s", resync_s));
  FORESIGHT_CHECK(NotNegative("first_backoff_s", first_backoff_s));
  return NotNegative("last_backoff_s", last_backoff_s);
}

const char* ToString(GigeCameraOptions::Format format) {
  switch (format) {
    case GigeCameraOptions::Format::kMono8:
      return "Mono8";
    case GigeCameraOptions::Format::kBayerRG8:
      return "BayerRG8";
    case GigeCameraOptions::Format::kRGB8:
      return "RGB8";
  }
  return "unknown";
}

}  // namespace foresight
