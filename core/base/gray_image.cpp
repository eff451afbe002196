#include "core/base/gray_image.h"

#include <algorithm>

namespace foresight {

bool IsGray(const ColorImage& image) {
  return std::all_of(image.values().begin(), image.values().end(),
                     [](const Rgb8& p) { return p.r == p.g && p.g == p.b; });
}

GrayImage RedOf(const ColorImage& image) {
  GrayImage red(image.width(), image.height());
  std::transform(image.values().begin(), image.values().end(), red.values().begin(),
                 [](const Rgb8& p) { return p.r; });
  return red;
}

ColorImage ColorOf(const GrayImage& image) {
  ColorImage color(image.width(), image.height());
  std::transform(image.values().begin(), image.values().end(), color.values().begin(),
                 [](std::uint8_t level) {
                   return Rgb8{level, level, level};
                 });
  return color;
}

}  // namespace foresight
