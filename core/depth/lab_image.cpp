#include "core/depth/lab_image.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "core/base/parallel.h"

namespace foresight {
namespace {

constexpr int kLabBlockRows = 8;

void ConvertRows(const ColorImage& image, int top, LabImage& lab_image) {
  const int rows = std::min(kLabBlockRows, image.height() - top);
  const cv::Mat rgb(rows, image.width(), CV_8UC3, const_cast<Rgb8*>(image.row(top)));
  cv::Mat scaled, lab;
  rgb.convertTo(scaled, CV_32F, 1.0 / 255.0);
  cv::cvtColor(scaled, lab, cv::COLOR_RGB2Lab);
  cv::Mat planes[3];
  for (int c = 0; c < 3; ++c)
    planes[c] = cv::Mat(rows, image.width(), CV_32F, lab_image.channels[c].row(top));
  cv::split(lab, planes);
}

}  // namespace

void PrepareLab() {
  LabImage lab;
  for (auto& channel : lab.channels) channel = FloatImage(1, 1);
  ConvertRows(ColorImage(1, 1), 0, lab);
}

Result<LabImage> ToLab(const ColorImage& image, const RunContext& context) {
  LabImage lab;
  for (auto& channel : lab.channels) channel = FloatImage(image.width(), image.height());
  const int blocks = (image.height() + kLabBlockRows - 1) / kLabBlockRows;
  const bool finished = ParallelFor(
      blocks, context, [&](int block) { ConvertRows(image, block * kLabBlockRows, lab); });
  if (!finished) return Fail(ErrorCode::kCancelled, "upsampling was cancelled");
  return lab;
}

}  // namespace foresight
