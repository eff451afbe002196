#include "core/pictures/sample_picture.h"

#include <cmath>

namespace foresight {
namespace {

constexpr Rgb8 kBackground = {24, 26, 30};

/// A square from the sample's pixel + `from` to its pixel + 1.
void PaintDot(ColorImage& picture, const AlignedSample& sample, int from, Rgb8 color) {
  const auto x = static_cast<int>(std::lround(sample.u));
  const auto y = static_cast<int>(std::lround(sample.v));
  for (int dy = from; dy <= 1; ++dy)
    for (int dx = from; dx <= 1; ++dx)
      if (picture.Contains(x + dx, y + dy)) picture(x + dx, y + dy) = color;
}

}  // namespace

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
  ColorImage picture(samples.width, samples.height, kBackground);
  for (std::size_t i = 0; i < samples.samples.size(); ++i) {
    const AlignedSample& s = samples.samples[i];
    const bool kept = samples.reasons[i] == RejectReason::kKept;
    PaintDot(picture, s, 0,
             kept ? ColorOf(ColorMap::kTurbo, depth_m.Fraction(static_cast<double>(s.depth_m)))
                  : ColorOf(samples.reasons[i]));
  }
  return picture;
}

ColorImage PaintRejections(const AlignedSamples& samples) {
  ColorImage picture(samples.width, samples.height, kBackground);
  for (std::size_t i = 0; i < samples.samples.size(); ++i)
    if (samples.reasons[i] == RejectReason::kKept)
      PaintDot(picture, samples.samples[i], 0, kKeptSample);
  for (std::size_t i = 0; i < samples.samples.size(); ++i)
    if (samples.reasons[i] != RejectReason::kKept)
      PaintDot(picture, samples.samples[i], -1, ColorOf(samples.reasons[i]));
  return picture;
}

}  // namespace foresight
