#include "core/depth/lidar_coverage.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace foresight {
namespace {

constexpr double kReach_spacings = 2.0;

}  // namespace

FloatImage LidarCoverage(const AlignedSamples& samples) {
  const auto spacing = MeasureSpacing(samples);
  cv::Mat1b nothing(samples.height, samples.width, static_cast<uchar>(255));
  for (std::size_t i = 0; i < samples.samples.size(); ++i) {
    if (samples.reasons[i] != RejectReason::kKept) continue;
    const int x = static_cast<int>(std::lround(samples.samples[i].u));
    const int y = static_cast<int>(std::lround(samples.samples[i].v));
    if (x >= 0 && y >= 0 && x < samples.width && y < samples.height) nothing(y, x) = 0;
  }
  cv::Mat1f distance;
  cv::distanceTransform(nothing, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  // Samples without neighbours stand for their own pixel.
  const double spacing_px =
      spacing ? std::max(spacing->along_line_px, spacing->between_lines_px) : 0.0;
  const auto reach = static_cast<float>(kReach_spacings * spacing_px);
  FloatImage coverage(samples.width, samples.height, 0.0f);
  for (int y = 0; y < samples.height; ++y)
    for (int x = 0; x < samples.width; ++x)
      if (distance(y, x) <= reach) coverage(x, y) = 1.0f;
  return coverage;
}

}  // namespace foresight
