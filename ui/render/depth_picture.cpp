#include "ui/render/depth_picture.h"

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

}  // namespace

ColorImage PaintDepth(const DenseDepth& dense, const MaskImage* mask, DepthLayer layer,
                      const ValueRange& range) {
  const bool is_depth = layer == DepthLayer::kDepth;
  const auto table = TableOf(is_depth ? ColorMap::kTurbo : ColorMap::kCividis);
  const FloatImage& source = is_depth ? dense.depth_m : dense.confidence;
  const double unit = is_depth || dense.max_confidence <= 0.0f ? 1.0 : dense.max_confidence;
  ColorImage picture(source.width(), source.height());
  for (int y = 0; y < source.height(); ++y) {
    for (int x = 0; x < source.width(); ++x) {
      const double value = source(x, y) / unit;
      if (!std::isfinite(dense.depth_m(x, y))) {
        picture(x, y) = kNothing;
      } else if (mask != nullptr && (*mask)(x, y) == 0) {
        picture(x, y) = Hatch(x, y);
      } else {
        const double fraction = std::clamp(range.Fraction(value), 0.0, 1.0);
        picture(x, y) = table[static_cast<std::size_t>(std::lround(255.0 * fraction))];
      }
    }
  }
  return picture;
}

ValueRange RangeOf(const DenseDepth& dense, const MaskImage* mask, DepthLayer layer) {
  if (layer == DepthLayer::kConfidence) return {0.0, 1.0};
  const ValueRange range = mask == nullptr ? RobustRange(dense.depth_m.values())
                                           : RobustRange(ApplyMask(dense.depth_m, *mask).values());
  // On a flat wall the colours would otherwise show nothing but noise.
  const double widen = std::max(0.0, kLeastSpan_m - (range.high - range.low)) / 2.0;
  return {range.low - widen, range.high + widen};
}

}  // namespace foresight
