#include "core/pictures/error_picture.h"

#include <cmath>

namespace foresight {
namespace {

constexpr Rgb8 kNotScored = {214, 216, 220};
constexpr Rgb8 kMasked = {16, 17, 20};
constexpr ColorMap kMap = ColorMap::kTurbo;

}  // namespace

ColorImage PaintError(const DepthImage& depth_m, const MaskImage* mask, const DepthImage& truth_m,
                      double full_scale_m) {
  FORESIGHT_EXPECTS(depth_m.SameSize(truth_m) && (mask == nullptr || depth_m.SameSize(*mask)),
                    "depth, mask and truth have one size");
  ColorImage picture(depth_m.width(), depth_m.height(), kNotScored);
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      if (std::isnan(truth_m(x, y))) continue;
      const bool kept = (mask == nullptr || (*mask)(x, y) != 0) && !std::isnan(depth_m(x, y));
      const double error_m = std::abs(static_cast<double>(depth_m(x, y)) - truth_m(x, y));
      picture(x, y) = kept ? ColorOf(kMap, error_m / full_scale_m) : kMasked;
    }
  return picture;
}

PictureLegend LegendOfError(double full_scale_m) {
  PictureLegend legend;
  legend.bar = {kMap, {0.0, 1000.0 * full_scale_m}, "mm", true};
  legend.swatches = {{kMasked, "masked"}, {kNotScored, "no truth, not scored"}};
  return legend;
}

}  // namespace foresight
