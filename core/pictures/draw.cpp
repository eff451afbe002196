#include "core/pictures/draw.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace foresight {
namespace {

/// OpenCV draws at sixteenths of a pixel when told so.
constexpr int kShift = 4;
/// Far outside any image, but far inside OpenCV's integers.
constexpr double kLimit_px = 1e5;

cv::Mat View(ColorImage& image) {
  return {image.height(), image.width(), CV_8UC3, image.data()};
}

cv::Scalar Scalar(Rgb8 color) {
  return {double(color.r), double(color.g), double(color.b)};
}

cv::Point Fixed(const Eigen::Vector2d& pixel) {
  const auto to_fixed = [](double value) {
    return static_cast<int>(std::lround(std::clamp(value, -kLimit_px, kLimit_px) * (1 << kShift)));
  };
  return {to_fixed(pixel.x()), to_fixed(pixel.y())};
}

void Draw(ColorImage& image, const std::vector<Eigen::Vector2d>& points, Rgb8 color,
          int thickness_px) {
  std::vector<cv::Point> fixed;
  for (const auto& point : points)
    if (point.allFinite()) fixed.push_back(Fixed(point));
  if (fixed.size() < 2) return;
  cv::Mat view = View(image);
  cv::polylines(view, fixed, false, Scalar(color), thickness_px, cv::LINE_AA, kShift);
}

}  // namespace

void DrawPolylines(ColorImage& image, const std::vector<std::vector<Eigen::Vector2d>>& lines,
                   Rgb8 color, int thickness_px) {
  for (const auto& line : lines) Draw(image, line, color, thickness_px);
}

}  // namespace foresight
