#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>
#include <zlib.h>

#include "core/base/atomic_file.h"
#include "core/base/random.h"
#include "core/io/png.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

using testing::HasSubstr;

ColorImage RandomColors(int width, int height, std::uint64_t seed) {
  Random random(seed);
  ColorImage image(width, height);
  const auto channel = [&] { return static_cast<std::uint8_t>(random.Index(256)); };
  for (Rgb8& pixel : image.values()) pixel = {channel(), channel(), channel()};
  return image;
}

/// A PNG made by libpng's own simplified interface, which our writer does not use.
std::string ForeignPng(int width, int height, png_uint_32 format, const void* pixels,
                       const void* palette, int colors) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = format;
  image.colormap_entries = static_cast<png_uint_32>(colors);
  png_alloc_size_t size = 0;
  png_image_write_to_memory(&image, nullptr, &size, 0, pixels, 0, palette);
  std::string bytes(size, '\0');
  png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels, 0, palette);
  bytes.resize(size);
  return bytes;
}

TEST(Png, ColorsComeBackAsTheyWereWritten) {
  const TemporaryFolder folder;
  const ColorImage image = RandomColors(37, 23, 1);
  ASSERT_TRUE(WritePng(folder / "a.png", image));
  EXPECT_EQ(ReadPng(folder / "a.png").value(), image);
}

TEST(Png, ACaptureComesBackAsItWasAndIsSmallerThanAsADrawing) {
  Random random(3);
  ColorImage capture(320, 240);
  for (int y = 0; y < 240; ++y)
    for (int x = 0; x < 320; ++x) {
      const auto channel = [&] { return static_cast<std::uint8_t>(90 + y / 3 + random.Index(8)); };
      capture(x, y) = {channel(), channel(), channel()};
    }
  const std::string bytes = EncodePng(capture, PngContent::kCapture).value();
  EXPECT_EQ(DecodePng(bytes, "a capture").value(), capture);
  EXPECT_LT(bytes.size(), EncodePng(capture, PngContent::kDrawing)->size());
  ColorImage drawing(320, 240);
  for (int y = 0; y < 240; ++y)
    for (int x = 0; x < 320; ++x) {
      const auto shade = static_cast<std::uint8_t>(x * x % 31 * (y / 16 % 5));
      drawing(x, y) = {shade, 0, static_cast<std::uint8_t>(255 - shade)};
    }
  EXPECT_LT(EncodePng(drawing)->size(), EncodePng(drawing, PngContent::kCapture)->size());
}

TEST(Png, GreysComeBackAsTheyWereWritten) {
  const TemporaryFolder folder;
  GrayImage image(5, 3);
  for (int i = 0; i < 15; ++i) image.values()[i] = static_cast<std::uint8_t>(17 * i);
  ASSERT_TRUE(WritePng(folder / "a.png", image));
  EXPECT_EQ(ReadPngGray(folder / "a.png").value(), image);
}

TEST(Png, SixteenBitsAreScaledToEight) {
  Image<std::uint16_t> image(3, 1);
  image(0, 0) = 0;
  image(1, 0) = 0x8080;  // exactly 128 * 257
  image(2, 0) = 0xffff;
  const GrayImage read = DecodePngGray(EncodePng16(image).value(), "memory").value();
  EXPECT_THAT(read.values(), testing::ElementsAre(0, 128, 255));
}

TEST(Png, SixteenBitsAreStoredBigEnd) {
  const Image<std::uint16_t> image(1, 1, 0x1234);
  std::string bytes = EncodePng16(image).value();
  png_image foreign{};
  foreign.version = PNG_IMAGE_VERSION;
  ASSERT_TRUE(png_image_begin_read_from_memory(&foreign, bytes.data(), bytes.size()));
  foreign.format = PNG_FORMAT_LINEAR_Y;
  png_uint_16 value = 0;
  ASSERT_TRUE(png_image_finish_read(&foreign, nullptr, &value, 0, nullptr));
  EXPECT_EQ(value, 0x1234);
}

TEST(Png, APaletteIsResolvedToItsColors) {
  const std::uint8_t palette[] = {10, 20, 30, 200, 100, 50};
  const std::uint8_t indices[] = {1, 0};
  const std::string bytes = ForeignPng(2, 1, PNG_FORMAT_RGB_COLORMAP, indices, palette, 2);
  const ColorImage image = DecodePng(bytes, "memory").value();
  EXPECT_EQ(image(0, 0), (Rgb8{200, 100, 50}));
  EXPECT_EQ(image(1, 0), (Rgb8{10, 20, 30}));
}

TEST(Png, AlphaIsDroppedWithoutBlending) {
  const std::uint8_t pixels[] = {10, 20, 30, 0, 40, 50, 60, 128};
  const std::string bytes = ForeignPng(2, 1, PNG_FORMAT_RGBA, pixels, nullptr, 0);
  const ColorImage image = DecodePng(bytes, "memory").value();
  EXPECT_EQ(image(0, 0), (Rgb8{10, 20, 30}));
  EXPECT_EQ(image(1, 0), (Rgb8{40, 50, 60}));
}

TEST(Png, AGreyImageReadAsColorsHasThreeEqualChannels) {
  const std::string bytes = EncodePng(GrayImage(2, 2, 77)).value();
  EXPECT_EQ(DecodePng(bytes, "memory").value(), ColorImage(2, 2, Rgb8{77, 77, 77}));
}

TEST(Png, EveryTruncationIsAnErrorThatNamesTheFile) {
  const std::string bytes = EncodePng(RandomColors(20, 20, 2)).value();
  for (std::size_t length = 0; length < bytes.size(); length += 7) {
    const auto read = DecodePng(std::string_view(bytes).substr(0, length), "cut.png");
    ASSERT_FALSE(read) << length << " bytes";
    EXPECT_EQ(read.error().code, ErrorCode::kBadData);
    EXPECT_THAT(read.error().message, HasSubstr("cut.png"));
  }
}

TEST(Png, ADamagedByteIsAnErrorOrChangesNothing) {
  const ColorImage image = RandomColors(20, 20, 3);
  const std::string bytes = EncodePng(image).value();
  Random random(3);
  int errors = 0;
  for (int i = 0; i < 300; ++i) {
    std::string damaged = bytes;
    damaged[static_cast<std::size_t>(random.Index(static_cast<int>(bytes.size())))] ^=
        static_cast<char>(1 + random.Index(255));
    const auto read = DecodePng(damaged, "memory");
    if (!read) {
      ++errors;
      continue;
    }
    EXPECT_EQ(*read, image);
  }
  EXPECT_GT(errors, 100) << "CRCs cover nearly all of the file";
}

TEST(Png, AHugeImageIsRefusedBeforeItsMemoryIsTaken) {
  std::string bytes = EncodePng(GrayImage(8, 8)).value();
  // The width and height lie at byte 16 and 20, big end first; their CRC at 29 must fit again.
  for (const int at : {16, 20}) {
    bytes[static_cast<std::size_t>(at) + 2] = 0x4e;
    bytes[static_cast<std::size_t>(at) + 3] = 0x1f;  // 19999: within the limit on a side
  }
  const uLong crc = crc32(0, reinterpret_cast<const Bytef*>(bytes.data()) + 12, 17);
  for (int i = 0; i < 4; ++i)
    bytes[static_cast<std::size_t>(29 + i)] = static_cast<char>(crc >> (24 - 8 * i) & 0xff);
  const auto read = DecodePngGray(bytes, "bomb.png");
  ASSERT_FALSE(read);
  EXPECT_THAT(read.error().message, HasSubstr("cannot hold an image of 19999 x 19999"));
}

TEST(Png, AnotherKindOfFileIsCalledThat) {
  const auto read = DecodePng("GIF89a whatever", "a.png");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().message, "a.png: is not a PNG file");
}

TEST(Png, AnEmptyImageCannotBeWritten) {
  EXPECT_EQ(EncodePng(ColorImage()).error().code, ErrorCode::kInvalidInput);
}

TEST(Png, SixteenBitsSurviveTheRoundTripAndOtherImagesAreNoNumbers) {
  const TemporaryFolder folder;
  Image<std::uint16_t> depth_mm(3, 2, 0);
  depth_mm(0, 0) = 1234;
  depth_mm(2, 1) = 65535;
  ASSERT_TRUE(WritePng16(folder / "depth.png", depth_mm));
  const auto read = ReadPng16(folder / "depth.png");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ((*read)(0, 0), 1234);
  EXPECT_EQ((*read)(1, 0), 0);
  EXPECT_EQ((*read)(2, 1), 65535);
  ASSERT_TRUE(WritePng(folder / "picture.png", GrayImage(3, 2, 7)));
  const auto refused = ReadPng16(folder / "picture.png");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kBadData);
}

}  // namespace
}  // namespace foresight
