#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/sensor/camera_frame.h"
#include "hardware/api/camera_health.h"

namespace foresight {

struct CameraSettings {
  double exposure_s = 0.004;
  double gain_db = 0.0;
};

/// A camera with a software trigger. Calls from one thread at a time, except Health, which any
/// thread may call at any time.
class Camera {
 public:
  virtual ~Camera() = default;

  virtual std::string Describe() const = 0;
  virtual Status Connect() = 0;
  virtual Status Configure(const CameraSettings& settings) = 0;
  /// Starts one exposure and returns at once the `seq` of its frame, which comes from WaitForFrame.
  virtual Result<std::int64_t> Trigger() = 0;
  /// The oldest frame not yet handed out, waiting at most `timeout`; nullopt when none came. The
  /// motor's angles in it are not filled in. Fails once for each image that is given up.
  virtual Result<std::optional<CameraFrame>> WaitForFrame(std::chrono::milliseconds timeout) = 0;
  /// Never waits for the device. What a device cannot know stays at its default.
  virtual CameraHealth Health() const = 0;
};

}  // namespace foresight
