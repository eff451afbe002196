#include "core/depth/reject_isolated.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace foresight {
namespace {

cv::Mat Box(int width, int height) {
  return cv::getStructuringElement(cv::MORPH_RECT, cv::Size(width, height));
}

int Round(double value) {
  return static_cast<int>(std::lround(value));
}

}  // namespace

Status IsolatedPointOptions::Check() const {
  if (grow_px < 1 || grow_px > 100)
    return Fail(ErrorCode::kInvalidOptions, "isolated points: grow_px {} is not in [1, 100]",
                grow_px);
  for (const double spacing : {along_line_px, between_lines_px})
    if (!(spacing >= 0.0 && spacing < 1000.0))
      return Fail(ErrorCode::kInvalidOptions, "isolated points: spacing {} px is not in [0, 1000)",
                  spacing);
  return {};
}

Status RejectIsolated(AlignedSamples& samples, const IsolatedPointOptions& options) {
  FORESIGHT_CHECK(options.Check());
  if (!options.enabled) return {};
  SampleSpacing spacing{options.along_line_px, options.between_lines_px};
  if (spacing.along_line_px == 0.0 || spacing.between_lines_px == 0.0) {
    FORESIGHT_TRY(const SampleSpacing measured, MeasureSpacing(samples));
    if (spacing.along_line_px == 0.0) spacing.along_line_px = measured.along_line_px;
    if (spacing.between_lines_px == 0.0) spacing.between_lines_px = measured.between_lines_px;
  }
  const int du = std::max(1, Round(spacing.along_line_px));
  const int dv = std::max(1, Round(spacing.between_lines_px));

  cv::Mat covered(samples.height, samples.width, CV_8U, cv::Scalar(0));
  const auto pixel_of = [&](const AlignedSample& s) {
    return cv::Point(Round(static_cast<double>(s.u)), Round(static_cast<double>(s.v)));
  };
  const auto inside = [&](const cv::Point& p) {
    return p.x >= 0 && p.y >= 0 && p.x < samples.width && p.y < samples.height;
  };
  for (std::size_t i = 0; i < samples.samples.size(); ++i) {
    const cv::Point p = pixel_of(samples.samples[i]);
    if (samples.reasons[i] == RejectReason::kKept && inside(p)) covered.at<std::uint8_t>(p) = 255;
  }
  cv::dilate(covered, covered, Box(du + options.grow_px, dv + options.grow_px));
  cv::morphologyEx(covered, covered, cv::MORPH_OPEN, Box(2 * du + 1, 2 * dv + 1));
  for (std::size_t i = 0; i < samples.samples.size(); ++i) {
    const cv::Point p = pixel_of(samples.samples[i]);
    if (samples.reasons[i] == RejectReason::kKept && inside(p) && covered.at<std::uint8_t>(p) == 0)
      samples.reasons[i] = RejectReason::kIsolated;
  }
  return {};
}

}  // namespace foresight
