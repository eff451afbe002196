// The driver's arithmetic: pixels to colours, a device's clock to the head's.
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "hardware/gige/camera_clock.h"
#include "hardware/gige/pixel_formats.h"

namespace foresight {
namespace {

using Format = GigeCameraOptions::Format;

/// What a sensor behind the mosaic sees of an image.
std::vector<std::uint8_t> MosaicOf(const ColorImage& image) {
  std::vector<std::uint8_t> raw;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const Rgb8 pixel = image(x, y);
      raw.push_back(x % 2 != y % 2 ? pixel.g : (y % 2 == 0 ? pixel.r : pixel.b));
    }
  return raw;
}

TEST(ToColorImage, AnEvenColourComesThroughTheMosaicUpToTheBorder) {
  for (const auto& [width, height] : {std::pair(6, 4), std::pair(7, 5), std::pair(2, 2)}) {
    const ColorImage image(width, height, Rgb8{200, 100, 50});
    EXPECT_EQ(ToColorImage(MosaicOf(image), Format::kBayerRG8, width, height).value(), image);
  }
}

TEST(ToColorImage, ARampComesThroughTheMosaicInside) {
  ColorImage image(20, 16);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 20; ++x)
      image(x, y) = {static_cast<std::uint8_t>(4 * x + 2 * y),
                     static_cast<std::uint8_t>(100 + 2 * x),
                     static_cast<std::uint8_t>(200 - 4 * y)};
  const ColorImage back = ToColorImage(MosaicOf(image), Format::kBayerRG8, 20, 16).value();
  for (int y = 1; y < 15; ++y)
    for (int x = 1; x < 19; ++x) EXPECT_EQ(back(x, y), image(x, y)) << x << ", " << y;
}

TEST(ToColorImage, MonoIsTheSameInAllChannels) {
  const std::vector<std::uint8_t> raw = {1, 2, 3, 4, 5, 6};
  const ColorImage image = ToColorImage(raw, Format::kMono8, 3, 2).value();
  EXPECT_EQ(image(2, 1), (Rgb8{6, 6, 6}));
}

TEST(ToColorImage, RefusesBytesThatDoNotFitTheSize) {
  const std::vector<std::uint8_t> raw(17);
  for (const Format format : {Format::kMono8, Format::kBayerRG8, Format::kRGB8}) {
    const auto image = ToColorImage(raw, format, 3, 2);
    ASSERT_FALSE(image);
    EXPECT_EQ(image.error().code, ErrorCode::kBadData);
  }
}

TEST(CameraClock, TheTruthLiesWithinItsUncertainty) {
  Random random(3);
  for (int run = 0; run < 200; ++run) {
    const double offset_s = random.Uniform(-1e5, 1e5);
    std::vector<CameraClock::Reading> readings;
    double now_s = 10.0;
    double shortest_s = 1.0;
    for (int i = 0; i < 8; ++i) {
      const double there_s = random.Uniform(5e-5, 1e-3);
      const double back_s = random.Uniform(5e-5, 1e-3);
      readings.push_back({now_s, now_s + there_s + back_s, now_s + there_s - offset_s});
      shortest_s = std::min(shortest_s, there_s + back_s);
      now_s += 0.01;
    }
    const CameraClock clock(readings);
    // 1e-10: the numbers themselves, at 1e5 s.
    EXPECT_LE(std::abs(clock.offset_s() - offset_s), clock.uncertainty_s() + 1e-10);
    EXPECT_LE(clock.uncertainty_s(), 0.5 * shortest_s + 1e-10);
    EXPECT_NEAR(clock.ToHead(7.0), 7.0 + clock.offset_s(), 1e-12);
  }
}

TEST(CameraClock, OfReadingsThatContradictEachOtherTheQuickestDecides) {
  const std::vector<CameraClock::Reading> readings = {{0.0, 0.010, 100.0}, {1.0, 1.001, 50.0}};
  const CameraClock clock(readings);
  EXPECT_NEAR(clock.offset_s(), 1.0005 - 50.0, 1e-12);
  EXPECT_NEAR(clock.uncertainty_s(), 0.0005, 1e-12);
}

TEST(GigeCameraOptions, NameTheMemberAtFault) {
  GigeCameraOptions options;
  EXPECT_TRUE(options.Check());
  options.packet_bytes = 100;
  ASSERT_FALSE(options.Check());
  EXPECT_NE(options.Check().error().message.find("packet_bytes"), std::string::npos);
  options = {};
  options.frame_timeout_s = std::nan("");
  EXPECT_FALSE(options.Check());
}

}  // namespace
}  // namespace foresight
