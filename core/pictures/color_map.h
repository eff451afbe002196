#pragma once

#include <span>

#include "core/base/image.h"

namespace foresight {

/// Colours for a value in [0, 1]; values outside are clamped.
enum class ColorMap {
  kTurbo,    ///< depth, range, height: most detail
  kViridis,  ///< even steps, brighter all the way
  kCividis,  ///< confidence: the same to the colour-blind
  kGray,     ///< intensity
  kBalance,  ///< residuals: blue below 0.5, white there, orange above
};

Rgb8 ColorOf(ColorMap map, double value);

/// What people see of a map.
struct ColorMapInfo {
  ColorMap map;
  const char* title;
};
/// The maps that suit depth, the default first.
std::span<const ColorMapInfo> DepthColorMaps();

/// Lowest and highest value that the colours span.
struct ValueRange {
  double low = 0.0;
  double high = 1.0;

  double Fraction(double value) const { return (value - low) / (high - low); }
};

/// From the 1st to the 99th percentile of the finite values, so that a few outliers do not eat the
/// colours; [0, 1] when there are none. Looks at no more than about 50,000 of them.
ValueRange RobustRange(std::span<const float> values);

}  // namespace foresight
