#pragma once

#include <string>

#include "core/base/image.h"
#include "core/base/result.h"

namespace foresight {

inline constexpr std::size_t kMaxThumbnailBytes = 8192;

/// The image, smaller, as a PNG of at most kMaxThumbnailBytes: up to 128 pixels wide or high, fewer
/// where the image is too busy for that many bytes. Fails with kInvalidInput for an empty image.
Result<std::string> ThumbnailOf(const ColorImage& image);

}  // namespace foresight
