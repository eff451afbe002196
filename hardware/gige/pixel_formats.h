#pragma once

#include <cstdint>
#include <span>

#include "core/base/image.h"
#include "core/base/result.h"
#include "hardware/gige/gige_camera_options.h"

namespace foresight {

/// A camera's pixels, row by row without padding, as a colour image. Mono8 gives r = g = b.
/// BayerRG8 (red at (0, 0)) is interpolated bilinearly: channels that were measured are exact, at
/// the border neighbours are mirrored. Fails with kBadData when the bytes do not fit the size.
Result<ColorImage> ToColorImage(std::span<const std::uint8_t> pixels,
                                GigeCameraOptions::Format format, int width, int height);

}  // namespace foresight
