#include "core/io/jpeg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "core/base/gray_image.h"
#include "core/io/image_file.h"

namespace foresight {
namespace {

using testing::HasSubstr;

ColorImage Slope(bool gray) {
  ColorImage image(61, 43);
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const auto level = static_cast<std::uint8_t>(40 + 2 * x + y);
      image(x, y) = {level, level, gray ? level : static_cast<std::uint8_t>(255 - level)};
    }
  return image;
}

int LargestDifference(const ColorImage& a, const ColorImage& b) {
  int largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Rgb8 &p = a.values()[i], &q = b.values()[i];
    largest = std::max({largest, std::abs(p.r - q.r), std::abs(p.g - q.g), std::abs(p.b - q.b)});
  }
  return largest;
}

TEST(Jpeg, KeepsASmoothImageNearly) {
  for (const bool gray : {true, false}) {
    const ColorImage image = Slope(gray);
    const auto back = DecodeJpeg(EncodeJpeg(image, 95).value(), "test");
    ASSERT_TRUE(back) << back.error().message;
    ASSERT_TRUE(back->SameSize(image));
    // Rounding of the coefficients; of colours also that of YCbCr at half the resolution.
    EXPECT_LE(LargestDifference(*back, image), gray ? 3 : 16);
    EXPECT_EQ(IsGray(*back), gray);
  }
}

TEST(Jpeg, OfAGreyImageIsReadAsGreyAndAsColour) {
  const std::string jpeg = EncodeJpeg(Slope(true), 90).value();
  EXPECT_EQ(ColorOf(DecodeJpegGray(jpeg, "test").value()), DecodeJpeg(jpeg, "test").value());
}

TEST(Jpeg, IsTheSameEveryTime) {
  EXPECT_EQ(EncodeJpeg(Slope(false), 50).value(), EncodeJpeg(Slope(false), 50).value());
}

TEST(Jpeg, RefusesWhatCannotBeOne) {
  EXPECT_EQ(EncodeJpeg(ColorImage(), 90).error().code, ErrorCode::kInvalidInput);
  EXPECT_EQ(EncodeJpeg(ColorImage(20001, 1), 90).error().code, ErrorCode::kInvalidInput);
  EXPECT_EQ(EncodeJpeg(Slope(true), 0).error().code, ErrorCode::kInvalidOptions);
  EXPECT_EQ(EncodeJpeg(Slope(true), 101).error().code, ErrorCode::kInvalidOptions);
}

TEST(Jpeg, RefusesDamageAndTooManyPixels) {
  const std::string jpeg = EncodeJpeg(Slope(true), 90).value();
  EXPECT_EQ(DecodeJpeg(jpeg.substr(0, jpeg.size() / 2), "x").error().code, ErrorCode::kBadData);
  EXPECT_EQ(DecodeJpeg("no JPEG", "x").error().code, ErrorCode::kBadData);
  EXPECT_THAT(DecodeJpeg(jpeg, "x", 61 * 43 - 1).error().message, HasSubstr("61 x 43"));
  EXPECT_TRUE(DecodeJpeg(jpeg, "x", 61 * 43));
}

}  // namespace
}  // namespace foresight
