#include "core/pictures/depth_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace foresight {
namespace {

constexpr Rgb8 kNothing = {46, 50, 56};
constexpr Rgb8 kHatchDark = {72, 77, 84};
constexpr Rgb8 kHatchLight = {112, 118, 126};
constexpr int kHatchPeriod_px = 16;
constexpr double kLeastSpan_m = 0.5;

Rgb8 Hatch(int x, int y) {
  return (x + y) % kHatchPeriod_px < kHatchPeriod_px / 3 ? kHatchLight : kHatchDark;
}

std::array<Rgb8, 256> TableOf(ColorMap map) {
  std::array<Rgb8, 256> table;
  for (std::size_t i = 0; i < table.size(); ++i)
    table[i] = ColorOf(map, static_cast<double>(i) / 255.0);
  return table;
}

/// Colours `values` where there is a depth; `range` is in their unit.
ColorImage Paint(const FloatImage& values, const DepthImage& depth_m, const MaskImage* mask,
                 ColorMap map, const ValueRange& range) {
  const auto table = TableOf(map);
  // A million pixels in the GUI thread: one multiplication each.
  const auto low = static_cast<float>(range.low);
  const auto scale = static_cast<float>(255.0 / (range.high - range.low));
  ColorImage picture(values.width(), values.height());
  for (int y = 0; y < values.height(); ++y) {
    for (int x = 0; x < values.width(); ++x) {
      if (!std::isfinite(depth_m(x, y))) {
        picture(x, y) = kNothing;
      } else if (mask != nullptr && (*mask)(x, y) == 0) {
        picture(x, y) = Hatch(x, y);
      } else {
        const float place = std::clamp((values(x, y) - low) * scale, 0.0f, 255.0f);
        picture(x, y) = table[static_cast<std::size_t>(place + 0.5f)];
      }
    }
  }
  return picture;
}

}  // namespace

ColorImage PaintDepth(const DepthImage& depth_m, const MaskImage* mask, ColorMap map,
                      const ValueRange& range) {
  return Paint(depth_m, depth_m, mask, map, range);
}

ColorImage PaintConfidence(const DenseDepth& dense, const MaskImage* mask,
                           const ValueRange& range) {
  const double unit =
      dense.max_confidence <= 0.0f ? 1.0 : static_cast<double>(dense.max_confidence);
  return Paint(dense.confidence, dense.depth_m, mask, ColorMap::kCividis,
               {range.low * unit, range.high * unit});
}

ColorImage PaintDepth(const DenseDepth& dense, const MaskImage* mask, DepthLayer layer,
                      const ValueRange& range) {
  return layer == DepthLayer::kDepth ? PaintDepth(dense.depth_m, mask, ColorMap::kTurbo, range)
                                     : PaintConfidence(dense, mask, range);
}

ValueRange DepthRangeOf(const DepthImage& depth_m, const MaskImage& mask) {
  const ValueRange range = RobustRange(ApplyMask(depth_m, mask).values());
  // On a flat wall the colours would otherwise show nothing but noise.
  const double widen = std::max(0.0, kLeastSpan_m - (range.high - range.low)) / 2.0;
  return {range.low - widen, range.high + widen};
}

}  // namespace foresight
