#pragma once

#include "core/depth/upsample.h"
#include "core/pictures/color_map.h"

namespace foresight {

/// What the depth pane shows of a result.
enum class DepthLayer { kDepth, kConfidence };

/// Paints a depth map in colours. Masked pixels become a grey diagonal hatch, never black, so that
/// they cannot be taken for far or near; pixels without a value are plain dark grey. `mask` may be
/// null: nothing is masked.
ColorImage PaintDepth(const DepthImage& depth_m, const MaskImage* mask, ColorMap map,
                      const ValueRange& range);

/// The same for the confidence relative to the largest, in cividis.
ColorImage PaintConfidence(const DenseDepth& dense, const MaskImage* mask, const ValueRange& range);

/// One of the two; depth in turbo.
ColorImage PaintDepth(const DenseDepth& dense, const MaskImage* mask, DepthLayer layer,
                      const ValueRange& range);

/// The span of the depths that the mask keeps, at least half a metre.
ValueRange DepthRangeOf(const DepthImage& depth_m, const MaskImage& mask);

}  // namespace foresight
