#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "core/sensor/camera_frame.h"
#include "hardware/link/chunks/chunk.h"

namespace foresight {

inline constexpr int kThumbnailSide_px = 161;
inline constexpr int kPreviewSide_px = 322;
inline constexpr int kSmallQuality = 50;
inline constexpr int kFullQuality = 90;

/// An image of a frame as it travels, with what is known of the frame.
struct FrameItem {
  std::shared_ptr<const CameraFrame> frame;  ///< its image is of the size that travelled
  int full_width = 0;
  int full_height = 0;
};

/// `largest_side_px` 0 = the full size. Fails with kInvalidInput for an image without pixels.
Result<std::string> EncodeFrameJpeg(const CameraFrame& frame, int largest_side_px, int quality);
/// Fails with kBadData.
Result<FrameItem> DecodeFrameJpeg(std::string_view bytes);

/// The frame with its image, lossless (lossless_image.h).
Result<std::string> EncodeFrameImage(const CameraFrame& frame);
Result<CameraFrame> DecodeFrameImage(std::string_view bytes);

}  // namespace foresight
