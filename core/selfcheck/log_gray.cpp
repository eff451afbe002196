#include "core/selfcheck/log_gray.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace foresight {

FloatImage LogGray(const ColorImage& image) {
  FloatImage gray(image.width(), image.height());
  for (std::size_t i = 0; i < image.size(); ++i) {
    const Rgb8& c = image.values()[i];
    gray.values()[i] = std::log1p(0.30f * c.r + 0.59f * c.g + 0.11f * c.b);
  }
  return gray;
}

namespace {

template <class Filter>
FloatImage Filtered(const FloatImage& image, const Filter& filter) {
  FloatImage filtered(image.width(), image.height());
  const cv::Mat from(image.height(), image.width(), CV_32F, const_cast<float*>(image.data()));
  cv::Mat to(image.height(), image.width(), CV_32F, filtered.data());
  filter(from, to);
  return filtered;
}

}  // namespace

FloatImage Blurred(const FloatImage& image, double sigma_px) {
  return Filtered(image, [&](const cv::Mat& from, cv::Mat& to) {
    cv::GaussianBlur(from, to, cv::Size(), sigma_px);
  });
}

FloatImage BoxMean(const FloatImage& image, int side_px) {
  return Filtered(image, [&](const cv::Mat& from, cv::Mat& to) {
    cv::blur(from, to, cv::Size(side_px, side_px));
  });
}

}  // namespace foresight
