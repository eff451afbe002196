#pragma once

#include <string>
#include <string_view>

#include "core/base/image.h"
#include "core/base/result.h"

namespace foresight {

inline constexpr std::int64_t kMostImagePixels = 32'000'000;

/// An image without loss, smaller than a PNG and made faster: predicted as lines of the lidar are;
/// a grey one takes one plane. Any size, none too. Fails with kInvalidInput for more than
/// kMostImagePixels.
Result<std::string> EncodeLosslessImage(const ColorImage& image);
/// Fails with kBadData; a claimed size takes memory only as the bytes are there.
Result<ColorImage> DecodeLosslessImage(std::string_view bytes);

}  // namespace foresight
