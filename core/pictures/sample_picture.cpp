#include "core/pictures/sample_picture.h"

#include <cmath>

namespace foresight {

Rgb8 ColorOf(RejectReason reason) {
  switch (reason) {
    case RejectReason::kFlying:
      return {230, 159, 0};
    case RejectReason::kIsolated:
      return {86, 180, 233};
    case RejectReason::kFlipping:
      return {204, 121, 167};
    case RejectReason::kKept:
      break;
  }
  return {255, 255, 255};
}

ColorImage PaintSamples(const AlignedSamples& samples, const ValueRange& depth_m) {
  ColorImage picture(samples.width, samples.height, {24, 26, 30});
  for (std::size_t i = 0; i < samples.samples.size(); ++i) {
    const AlignedSample& s = samples.samples[i];
    const bool kept = samples.reasons[i] == RejectReason::kKept;
    const Rgb8 color =
        kept ? ColorOf(ColorMap::kTurbo, depth_m.Fraction(static_cast<double>(s.depth_m)))
             : ColorOf(samples.reasons[i]);
    const auto x = static_cast<int>(std::lround(s.u));
    const auto y = static_cast<int>(std::lround(s.v));
    for (int dy = 0; dy <= 1; ++dy)
      for (int dx = 0; dx <= 1; ++dx)
        if (picture.Contains(x + dx, y + dy)) picture(x + dx, y + dy) = color;
  }
  return picture;
}

}  // namespace foresight
