#include "core/depth/sample_fill.h"

#include <algorithm>
#include <cmath>

namespace foresight {
namespace {

/// Means over 2 x 2 pixels, weighted by their counts.
SampleImage Halve(const SampleImage& fine) {
  SampleImage coarse;
  coarse.mean_m = DepthImage((fine.mean_m.width() + 1) / 2, (fine.mean_m.height() + 1) / 2, 0.0f);
  coarse.count = FloatImage(coarse.mean_m.width(), coarse.mean_m.height(), 0.0f);
  for (int y = 0; y < fine.mean_m.height(); ++y)
    for (int x = 0; x < fine.mean_m.width(); ++x) {
      coarse.mean_m(x / 2, y / 2) += fine.count(x, y) * fine.mean_m(x, y);
      coarse.count(x / 2, y / 2) += fine.count(x, y);
    }
  for (std::size_t i = 0; i < coarse.mean_m.size(); ++i)
    if (coarse.count.values()[i] > 0.0f) coarse.mean_m.values()[i] /= coarse.count.values()[i];
  return coarse;
}

/// The coarser image's value under the centre of a fine pixel, bilinear.
float Interpolate(const DepthImage& coarse, int fine_x, int fine_y) {
  const auto place = [](int fine, int size, int& low, int& high) {
    const float at = 0.5f * (static_cast<float>(fine) - 0.5f);
    const auto floor = static_cast<int>(std::floor(at));
    low = std::clamp(floor, 0, size - 1);
    high = std::clamp(floor + 1, 0, size - 1);
    return at - static_cast<float>(floor);
  };
  int left = 0, right = 0, top = 0, bottom = 0;
  const float fx = place(fine_x, coarse.width(), left, right);
  const float fy = place(fine_y, coarse.height(), top, bottom);
  return (1.0f - fy) * ((1.0f - fx) * coarse(left, top) + fx * coarse(right, top)) +
         fy * ((1.0f - fx) * coarse(left, bottom) + fx * coarse(right, bottom));
}

}  // namespace

Result<SampleImage> AverageByPixel(const AlignedSamples& samples, const ColorImage& guide) {
  FORESIGHT_CHECK(CheckUpsamplingInput(samples, guide));
  SampleImage image;
  image.mean_m = DepthImage(guide.width(), guide.height(), 0.0f);
  image.count = FloatImage(guide.width(), guide.height(), 0.0f);
  for (std::size_t i = 0; i < samples.samples.size(); ++i) {
    if (samples.reasons[i] != RejectReason::kKept) continue;
    const AlignedSample& s = samples.samples[i];
    const int x = std::clamp(static_cast<int>(std::lround(s.u)), 0, guide.width() - 1);
    const int y = std::clamp(static_cast<int>(std::lround(s.v)), 0, guide.height() - 1);
    float& count = image.count(x, y);
    count += 1.0f;
    image.mean_m(x, y) += (s.depth_m - image.mean_m(x, y)) / count;
    const bool first = image.farthest_m == 0.0f;
    image.nearest_m = first ? s.depth_m : std::min(image.nearest_m, s.depth_m);
    image.farthest_m = std::max(image.farthest_m, s.depth_m);
  }
  return image;
}

DepthImage FillSmoothly(const SampleImage& samples) {
  DepthImage filled = samples.mean_m;
  const auto empty = [](float count) { return count == 0.0f; };
  const auto counts = samples.count.values();
  if (filled.size() <= 1 || std::none_of(counts.begin(), counts.end(), empty)) return filled;
  const DepthImage coarse = FillSmoothly(Halve(samples));
  for (int y = 0; y < filled.height(); ++y)
    for (int x = 0; x < filled.width(); ++x)
      if (empty(samples.count(x, y))) filled(x, y) = Interpolate(coarse, x, y);
  return filled;
}

}  // namespace foresight
