#pragma once

#include <optional>
#include <string>

#include "core/base/image.h"
#include "core/base/result.h"

namespace foresight {

/// A part of an image, in its pixels.
struct PixelRegion {
  int left = 0;
  int top = 0;
  int width = 0;
  int height = 0;
};

/// What the operator wants to see while nothing is scanned.
struct LiveViewOptions {
  double rate_hz = 2.0;             ///< at most; a slow camera or link gives fewer
  int largest_side_px = 640;        ///< larger images are made smaller by averaging
  std::optional<PixelRegion> part;  ///< of the camera's image; nullopt = all of it
  double exposure_s = 0.004;
  double gain_db = 0.0;

  static constexpr double kFastest_hz = 30.0;

  /// Names the member at fault.
  Status Check() const;
};

struct LiveImage {
  ColorImage image;
  double time_s = 0.0;           ///< middle of the exposure, head's clock
  double motor_angle_rad = 0.0;  ///< when it came
  int full_width = 0;            ///< of the camera's image, before part and size were cut
  int full_height = 0;
};

/// Where the images go. Called from a thread of the head, never concurrently; return quickly.
class LiveViewSink {
 public:
  virtual ~LiveViewSink() = default;
  virtual void OnLiveImage(const LiveImage& image) = 0;
  /// The camera gave no image, in words; the head goes on trying.
  virtual void OnLiveViewTrouble(const std::string& what) = 0;
};

}  // namespace foresight
