#pragma once

#include <QImage>
#include <algorithm>
#include <cstdlib>

#include "core/base/image.h"

namespace foresight {

/// The fraction of pixels for which `matches` holds.
template <class Matches>
double FractionOf(const QImage& image, const Matches& matches) {
  qint64 count = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) count += matches(image.pixelColor(x, y)) ? 1 : 0;
  return static_cast<double>(count) / std::max(1, image.width() * image.height());
}

/// The fraction of pixels that differ clearly between two images of one size.
inline double FractionOfChanges(const QImage& a, const QImage& b) {
  constexpr int kClearly = 60;
  qint64 count = 0;
  for (int y = 0; y < std::min(a.height(), b.height()); ++y)
    for (int x = 0; x < std::min(a.width(), b.width()); ++x) {
      const QColor from = a.pixelColor(x, y), to = b.pixelColor(x, y);
      const int way = std::abs(from.red() - to.red()) + std::abs(from.green() - to.green()) +
                      std::abs(from.blue() - to.blue());
      count += way > kClearly ? 1 : 0;
    }
  return static_cast<double>(count) / std::max(1, a.width() * a.height());
}

/// Neither grey nor nearly black.
inline bool IsColoured(const QColor& color) {
  return color.value() > 50 && color.saturation() > 90;
}

inline bool IsNear(const QColor& color, Rgb8 wanted) {
  constexpr int kTolerance = 60;  // lines are antialiased over what lies below
  return std::abs(color.red() - wanted.r) < kTolerance &&
         std::abs(color.green() - wanted.g) < kTolerance &&
         std::abs(color.blue() - wanted.b) < kTolerance;
}

}  // namespace foresight
