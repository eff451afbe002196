#include "hardware/emulator/gvsp_ring.h"

#include <algorithm>

namespace foresight {
namespace {

/// ITU-R BT.601, in 256ths.
std::uint8_t Luma(Rgb8 pixel) {
  return static_cast<std::uint8_t>((77 * pixel.r + 150 * pixel.g + 29 * pixel.b + 128) >> 8);
}

std::uint8_t BayerChannel(Rgb8 pixel, int x, int y) {
  if (x % 2 != y % 2) return pixel.g;
  return y % 2 == 0 ? pixel.r : pixel.b;
}

}  // namespace

std::vector<std::uint8_t> EncodePixels(const ColorImage& image, gvsp::PixelFormat format) {
  std::vector<std::uint8_t> pixels;
  pixels.reserve(image.size() * static_cast<std::size_t>(gvsp::BytesPerPixel(format)));
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const Rgb8 pixel = image(x, y);
      if (format == gvsp::PixelFormat::kRGB8) {
        pixels.insert(pixels.end(), {pixel.r, pixel.g, pixel.b});
      } else {
        pixels.push_back(format == gvsp::PixelFormat::kMono8 ? Luma(pixel)
                                                             : BayerChannel(pixel, x, y));
      }
    }
  return pixels;
}

std::uint32_t GvspFrame::PacketCount() const {
  return static_cast<std::uint32_t>((pixels.size() + payload_bytes - 1) / payload_bytes) + 2;
}

std::vector<std::uint8_t> GvspFrame::Packet(std::uint32_t number) const {
  if (number == 0) return gvsp::EncodeLeader(block, leader);
  if (number == PacketCount() - 1) return gvsp::EncodeTrailer(block, number, leader.height);
  const std::size_t first = (number - 1) * payload_bytes;
  return gvsp::EncodePayload(
      block, number,
      std::span(pixels).subspan(first, std::min(payload_bytes, pixels.size() - first)));
}

void GvspRing::Add(std::shared_ptr<const GvspFrame> frame) {
  const std::lock_guard lock(mutex_);
  frames_[next_] = std::move(frame);
  next_ = (next_ + 1) % kKept;
}

std::shared_ptr<const GvspFrame> GvspRing::Find(std::uint16_t block) const {
  const std::lock_guard lock(mutex_);
  const auto found = std::find_if(frames_.begin(), frames_.end(), [&](const auto& frame) {
    return frame && frame->block == block;
  });
  return found == frames_.end() ? nullptr : *found;
}

void GvspRing::Clear() {
  const std::lock_guard lock(mutex_);
  frames_ = {};
}

}  // namespace foresight
