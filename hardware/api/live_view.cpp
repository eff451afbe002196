#include "hardware/api/live_view.h"

#include "core/sensor/exposure.h"

namespace foresight {

Status LiveViewOptions::Check() const {
  constexpr int kMostPixels = 1 << 16;
  if (!(rate_hz > 0.0 && rate_hz <= kFastest_hz))
    return Fail(ErrorCode::kInvalidOptions, "rate_hz: {} is not within 0 to {}", rate_hz,
                kFastest_hz);
  if (largest_side_px < 16 || largest_side_px > kMostPixels)
    return Fail(ErrorCode::kInvalidOptions, "largest_side_px: {} is not within 16 to {}",
                largest_side_px, kMostPixels);
  if (part && (part->left < 0 || part->top < 0 || part->width < 1 || part->height < 1 ||
               part->left > kMostPixels || part->top > kMostPixels || part->width > kMostPixels ||
               part->height > kMostPixels))
    return Fail(ErrorCode::kInvalidOptions,
                "part: {} x {} pixels at ({}, {}) is no part of an image", part->width,
                part->height, part->left, part->top);
  return CheckExposure(exposure_s, gain_db);
}

}  // namespace foresight
