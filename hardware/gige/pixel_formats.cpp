#include "hardware/gige/pixel_formats.h"

namespace foresight {
namespace {

using Format = GigeCameraOptions::Format;
using Pixels = std::span<const std::uint8_t>;

ColorImage FromMono(Pixels pixels, int width, int height) {
  ColorImage image(width, height);
  for (std::size_t i = 0; i < pixels.size(); ++i)
    image.values()[i] = {pixels[i], pixels[i], pixels[i]};
  return image;
}

ColorImage FromRgb(Pixels pixels, int width, int height) {
  ColorImage image(width, height);
  for (std::size_t i = 0; i < image.size(); ++i)
    image.values()[i] = {pixels[3 * i], pixels[3 * i + 1], pixels[3 * i + 2]};
  return image;
}

/// The neighbourhood of one pixel of a mosaic, mirrored at the border, so that what is found there
/// has the same colour as what would have been beyond.
class Mosaic {
 public:
  Mosaic(Pixels pixels, int width, int height) : pixels_(pixels), width_(width), height_(height) {}

  int At(int x, int y) const {
    return pixels_[static_cast<std::size_t>(Mirror(y, height_)) * static_cast<std::size_t>(width_) +
                   static_cast<std::size_t>(Mirror(x, width_))];
  }
  std::uint8_t Here(int x, int y) const { return static_cast<std::uint8_t>(At(x, y)); }
  std::uint8_t Beside(int x, int y) const { return Half(At(x - 1, y) + At(x + 1, y)); }
  std::uint8_t AboveAndBelow(int x, int y) const { return Half(At(x, y - 1) + At(x, y + 1)); }
  std::uint8_t Cross(int x, int y) const {
    return Quarter(At(x - 1, y) + At(x + 1, y) + At(x, y - 1) + At(x, y + 1));
  }
  std::uint8_t Corners(int x, int y) const {
    return Quarter(At(x - 1, y - 1) + At(x + 1, y - 1) + At(x - 1, y + 1) + At(x + 1, y + 1));
  }

 private:
  static int Mirror(int at, int size) {
    if (at < 0) return size > 1 ? -at : 0;
    return at < size ? at : (size > 1 ? 2 * size - 2 - at : 0);
  }
  static std::uint8_t Half(int sum) { return static_cast<std::uint8_t>((sum + 1) / 2); }
  static std::uint8_t Quarter(int sum) { return static_cast<std::uint8_t>((sum + 2) / 4); }

  Pixels pixels_;
  int width_;
  int height_;
};

ColorImage FromBayer(Pixels pixels, int width, int height) {
  const Mosaic raw(pixels, width, height);
  ColorImage image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const bool red_row = y % 2 == 0;
      if (x % 2 != y % 2) {
        const std::uint8_t beside = raw.Beside(x, y);
        const std::uint8_t above = raw.AboveAndBelow(x, y);
        image(x, y) = {red_row ? beside : above, raw.Here(x, y), red_row ? above : beside};
      } else {
        const std::uint8_t here = raw.Here(x, y);
        const std::uint8_t corners = raw.Corners(x, y);
        image(x, y) = {red_row ? here : corners, raw.Cross(x, y), red_row ? corners : here};
      }
    }
  return image;
}

}  // namespace

Result<ColorImage> ToColorImage(Pixels pixels, Format format, int width, int height) {
  const std::size_t channels = format == Format::kRGB8 ? 3 : 1;
  if (width <= 0 || height <= 0 ||
      pixels.size() !=
          channels * static_cast<std::size_t>(width) * static_cast<std::size_t>(height))
    return Fail(ErrorCode::kBadData, "an image of {} x {} {} has {} bytes", width, height,
                ToString(format), pixels.size());
  switch (format) {
    case Format::kMono8:
      return FromMono(pixels, width, height);
    case Format::kBayerRG8:
      return FromBayer(pixels, width, height);
    case Format::kRGB8:
      return FromRgb(pixels, width, height);
  }
  return Fail(ErrorCode::kBadData, "an unknown pixel format");
}

}  // namespace foresight
