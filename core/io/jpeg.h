#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/image.h"
#include "core/base/result.h"

namespace foresight {

/// A JPEG, baseline; `quality` 1 to 100 as libjpeg has it. An image whose pixels are all grey takes
/// one component. One version of libjpeg makes the same bytes of the same image. Fails with
/// kInvalidInput for an image without pixels or with a side longer than 20000, kInvalidOptions for
/// another quality.
Result<std::string> EncodeJpeg(const ColorImage& image, int quality);

/// A JPEG alone, grey or in colour. Fails with kBadData as DecodeJpegGray (image_file.h) does, and
/// for more than `most_pixels`.
Result<ColorImage> DecodeJpeg(std::string_view bytes, const std::string& source,
                              std::int64_t most_pixels = 200'000'000);

}  // namespace foresight
