#include "core/base/shrink_image.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace foresight {
namespace {

/// The mean of the pixels that [begin, end) covers in each direction.
Rgb8 MeanOf(const ColorImage& image, int left, int right, int top, int bottom) {
  std::array<std::int64_t, 3> sum = {};
  for (int y = top; y < bottom; ++y) {
    const Rgb8* row = image.row(y);
    for (int x = left; x < right; ++x) {
      sum[0] += row[x].r;
      sum[1] += row[x].g;
      sum[2] += row[x].b;
    }
  }
  const std::int64_t count = std::int64_t{right - left} * (bottom - top);
  const auto mean = [count](std::int64_t value) {
    return static_cast<std::uint8_t>((value + count / 2) / count);
  };
  return {mean(sum[0]), mean(sum[1]), mean(sum[2])};
}

}  // namespace

ColorImage ShrinkImage(const ColorImage& image, int largest_side) {
  const int side = std::max(image.width(), image.height());
  if (side <= largest_side) return image;
  const auto scaled = [&](int length) {
    return std::max(1, static_cast<int>(std::int64_t{length} * largest_side / side));
  };
  ColorImage small(scaled(image.width()), scaled(image.height()));
  const auto begin = [](int at, int count, int length) {
    return static_cast<int>(std::int64_t{at} * length / count);
  };
  for (int y = 0; y < small.height(); ++y)
    for (int x = 0; x < small.width(); ++x)
      small(x, y) = MeanOf(
          image, begin(x, small.width(), image.width()), begin(x + 1, small.width(), image.width()),
          begin(y, small.height(), image.height()), begin(y + 1, small.height(), image.height()));
  return small;
}

}  // namespace foresight
