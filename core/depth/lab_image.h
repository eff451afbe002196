#pragma once

#include "core/base/image.h"
#include "core/base/result.h"
#include "core/base/run_context.h"

namespace foresight {

/// An image in CIELAB, L in [0, 100].
struct LabImage {
  FloatImage channels[3];
};

/// OpenCV makes its tables at the first conversion, for a tenth of a second: a program that can
/// make them before there is an image calls this, on any thread.
void PrepareLab();

/// Converts from sRGB. Fails with kCancelled. O(pixels).
Result<LabImage> ToLab(const ColorImage& image, const RunContext& context);

}  // namespace foresight
