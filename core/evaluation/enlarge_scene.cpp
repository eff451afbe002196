#include "core/evaluation/enlarge_scene.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace foresight {
namespace {

/// Neighbours whose disparity differs by more, in pixels, lie on different surfaces.
constexpr float kOneSurface_px = 1.0f;

/// The disparity at a place between pixels, in pixels of the scene as it is.
float DisparityAt(const FloatImage& disparity, double x, double y) {
  const int width = disparity.width();
  const int height = disparity.height();
  const int x0 = std::clamp(static_cast<int>(std::floor(x)), 0, width - 1);
  const int y0 = std::clamp(static_cast<int>(std::floor(y)), 0, height - 1);
  const int x1 = std::min(x0 + 1, width - 1);
  const int y1 = std::min(y0 + 1, height - 1);
  const float corners[] = {disparity(x0, y0), disparity(x1, y0), disparity(x0, y1),
                           disparity(x1, y1)};
  const auto [low, high] = std::minmax_element(std::begin(corners), std::end(corners));
  const bool known =
      std::none_of(std::begin(corners), std::end(corners), [](float d) { return std::isnan(d); });
  if (known && *high - *low <= kOneSurface_px) {
    const auto fx = static_cast<float>(std::clamp(x - x0, 0.0, 1.0));
    const auto fy = static_cast<float>(std::clamp(y - y0, 0.0, 1.0));
    const float top = corners[0] + fx * (corners[1] - corners[0]);
    const float bottom = corners[2] + fx * (corners[3] - corners[2]);
    return top + fy * (bottom - top);
  }
  const int nearest_x = std::clamp(static_cast<int>(std::lround(x)), 0, width - 1);
  const int nearest_y = std::clamp(static_cast<int>(std::lround(y)), 0, height - 1);
  return disparity(nearest_x, nearest_y);
}

FloatImage EnlargeDisparity(const FloatImage& disparity, int factor) {
  FloatImage enlarged(disparity.width() * factor, disparity.height() * factor);
  for (int y = 0; y < enlarged.height(); ++y)
    for (int x = 0; x < enlarged.width(); ++x)
      enlarged(x, y) = static_cast<float>(factor) *
                       DisparityAt(disparity, (x + 0.5) / factor - 0.5, (y + 0.5) / factor - 0.5);
  return enlarged;
}

MaskImage EnlargeMask(const MaskImage& mask, int factor) {
  MaskImage enlarged(mask.width() * factor, mask.height() * factor);
  for (int y = 0; y < enlarged.height(); ++y)
    for (int x = 0; x < enlarged.width(); ++x) enlarged(x, y) = mask(x / factor, y / factor);
  return enlarged;
}

ColorImage EnlargeImage(const ColorImage& image, int factor) {
  ColorImage enlarged(image.width() * factor, image.height() * factor);
  const cv::Mat from(image.height(), image.width(), CV_8UC3, const_cast<Rgb8*>(image.data()));
  cv::Mat to(enlarged.height(), enlarged.width(), CV_8UC3, enlarged.data());
  cv::resize(from, to, to.size(), 0.0, 0.0, cv::INTER_CUBIC);
  return enlarged;
}

}  // namespace

StereoScene EnlargeScene(const StereoScene& scene, int factor) {
  FORESIGHT_EXPECTS(factor >= 1, "a scene is enlarged by a whole factor");
  if (factor == 1) return scene;
  StereoScene enlarged;
  const auto scaled_centre = [&](double c) { return (c + 0.5) * factor - 0.5; };
  enlarged.name = scene.name;
  enlarged.baseline_m = scene.baseline_m;
  enlarged.focal_px = scene.focal_px * factor;
  enlarged.left_cx = scaled_centre(scene.left_cx);
  enlarged.right_cx = scaled_centre(scene.right_cx);
  enlarged.cy = scaled_centre(scene.cy);
  enlarged.disparity_offset_px = scene.disparity_offset_px * factor;
  enlarged.right = EnlargeImage(scene.right, factor);
  enlarged.left_disparity = EnlargeDisparity(scene.left_disparity, factor);
  enlarged.right_disparity = EnlargeDisparity(scene.right_disparity, factor);
  enlarged.left_in_both = EnlargeMask(scene.left_in_both, factor);
  return enlarged;
}

}  // namespace foresight
