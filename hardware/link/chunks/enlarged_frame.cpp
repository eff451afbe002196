#include "hardware/link/chunks/enlarged_frame.h"

#include <opencv2/imgproc.hpp>

#include "hardware/link/chunks/lossless_image.h"

namespace foresight {
namespace {

cv::Mat Wrap(const ColorImage& image) {
  return {image.height(), image.width(), CV_8UC3, const_cast<Rgb8*>(image.data())};
}

}  // namespace

std::shared_ptr<const CameraFrame> EnlargedFrame(const FrameItem& item) {
  const std::int64_t pixels = std::int64_t{item.full_width} * item.full_height;
  if (item.frame->image.size() == 0 || pixels <= 0 || pixels > kMostImagePixels) return item.frame;
  ColorImage large(item.full_width, item.full_height);
  cv::Mat to = Wrap(large);
  cv::resize(Wrap(item.frame->image), to, to.size(), 0.0, 0.0, cv::INTER_LINEAR);
  auto frame = std::make_shared<CameraFrame>(*item.frame);
  frame->image = std::move(large);
  return frame;
}

}  // namespace foresight
