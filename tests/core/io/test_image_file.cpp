#include "core/io/image_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/png.h"

namespace foresight {
namespace {

using testing::HasSubstr;

/// A grey JPEG of 8 x 8 pixels of the value 128, without a quantised coefficient but the first:
/// made by hand from the format's tables.
std::string GreyJpeg() {
  std::string bytes = "\xff\xd8";
  const auto segment = [&bytes](char marker, const std::string& body) {
    bytes += '\xff';
    bytes += marker;
    const std::size_t length = body.size() + 2;
    bytes += static_cast<char>(length >> 8);
    bytes += static_cast<char>(length & 0xff);
    bytes += body;
  };
  segment('\xdb', std::string(1, '\0') + std::string(64, '\1'));            // quantisation: all 1
  segment('\xc0', std::string("\x08\x00\x08\x00\x08\x01\x01\x11\x00", 9));  // 8 x 8, one component
  // One code of one bit each: DC "0" = no difference, AC "0" = end of the block.
  const std::string one_code =
      std::string("\x01", 1) + std::string(15, '\0') + std::string(1, '\0');
  segment('\xc4', std::string(1, '\x00') + one_code);
  segment('\xc4', std::string(1, '\x10') + one_code);
  segment('\xda', std::string("\x01\x01\x00\x00\x3f\x00", 6));
  bytes += '\x3f';  // 00, then ones up to the byte's end
  bytes += "\xff\xd9";
  return bytes;
}

TEST(ImageFile, ReadsGreyValuesOfEachFormat) {
  const GrayImage image = [] {
    GrayImage i(3, 2, 7);
    i(2, 1) = 200;
    return i;
  }();
  EXPECT_EQ(DecodeImageGray(EncodePng(image).value(), "file").value(), image);
  EXPECT_EQ(DecodeImageGray(std::string("P5\n# by hand\n3 2\n255\n\7\7\7\7\7\xc8"), "file").value(),
            image);
  EXPECT_EQ(DecodeImageGray(GreyJpeg(), "file").value(), GrayImage(8, 8, 128));
}

TEST(ImageFile, SaysWhatIsDamaged) {
  const auto fault = [](const std::string& bytes) {
    const auto image = DecodeImageGray(bytes, "file");
    return image ? std::string("accepted") : image.error().message;
  };
  EXPECT_THAT(fault("hello"), HasSubstr("file: is no PNG, JPEG or binary PGM file"));
  EXPECT_THAT(fault(""), HasSubstr("is no PNG"));
  EXPECT_THAT(fault("P5\n3 2\n255\n\7\7"), HasSubstr("2 bytes for 3 x 2 pixels"));
  EXPECT_THAT(fault("P5\n3 2\n65535\n"), HasSubstr("values up to 65535"));
  EXPECT_THAT(fault("P5\nx"), HasSubstr("no size of an image"));
  const std::string jpeg = GreyJpeg();
  for (std::size_t length = 2; length + 3 < jpeg.size(); ++length)
    EXPECT_THAT(fault(jpeg.substr(0, length)), HasSubstr("damaged JPEG")) << length;
}

TEST(ImageFile, KnowsTheNamesOfImages) {
  EXPECT_TRUE(HasImageExtension("a/b.JPG"));
  EXPECT_TRUE(HasImageExtension("b.jpeg"));
  EXPECT_TRUE(HasImageExtension("b.png"));
  EXPECT_FALSE(HasImageExtension("b.txt"));
  EXPECT_FALSE(HasImageExtension("png"));
}

}  // namespace
}  // namespace foresight
