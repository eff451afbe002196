// The form of docs/protocols.md, written here once more in the plainest way, judges the fast one.
#include "hardware/link/chunks/lossless_image.h"

#include <gtest/gtest.h>

#include <random>

#include "core/base/gray_image.h"
#include "hardware/link/chunks/grid_predictor.h"
#include "hardware/link/chunks/item_bytes.h"

namespace foresight {
namespace {

enum class Content { kFlat, kNoise, kRamp, kEdges };

/// Colours that try all branches of the predictor: equal, smooth, steep and wild ones.
ColorImage Draw(Content content, int width, int height, bool gray) {
  std::mt19937 random(7);
  const auto noise = [&](int most) { return static_cast<int>(random() % (most + 1)); };
  const auto value = [&](int x, int y) -> std::uint8_t {
    switch (content) {
      case Content::kFlat:
        return 254;
      case Content::kNoise:
        return static_cast<std::uint8_t>(noise(255));
      case Content::kRamp:
        return static_cast<std::uint8_t>((x + y) / 3 % 256 ^ noise(3));
      case Content::kEdges:
        break;
    }
    return static_cast<std::uint8_t>((x / 5 + y / 3) % 2 == 0 ? noise(9) : 246 + noise(9));
  };
  ColorImage image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::uint8_t red = value(x, y);
      image(x, y) = gray ? Rgb8{red, red, red} : Rgb8{red, value(x, y), value(y, x)};
    }
  return image;
}

std::vector<GrayImage> PlanesOf(const ColorImage& image) {
  if (IsGray(image)) return {RedOf(image)};
  std::vector<GrayImage> planes(3, GrayImage(image.width(), image.height()));
  for (std::size_t i = 0; i < image.size(); ++i) {
    planes[0].values()[i] = image.values()[i].r;
    planes[1].values()[i] = image.values()[i].g;
    planes[2].values()[i] = image.values()[i].b;
  }
  return planes;
}

/// Value by value, as the document says.
std::string EncodedPlainly(const ColorImage& image) {
  constexpr int kSmooth = 6, kRowsPerPiece = 32;
  const GridPredictor predictor(kSmooth);
  const std::vector<GrayImage> planes = PlanesOf(image);
  ItemWriter writer;
  writer.U8(1)
      .Varint(static_cast<std::uint64_t>(image.width()))
      .Varint(static_cast<std::uint64_t>(image.height()))
      .U8(static_cast<std::uint8_t>(planes.size()));
  for (const GrayImage& plane : planes) {
    const auto columns = static_cast<std::size_t>(plane.width());
    std::string differences;
    for (int y = 0; y < plane.height(); ++y) {
      const std::span<const std::uint8_t> above(y > 0 ? plane.row(y - 1) : nullptr,
                                                y > 0 ? columns : 0);
      for (std::size_t x = 0; x < columns; ++x) {
        const auto difference =
            static_cast<std::uint8_t>(plane.row(y)[x] - predictor.Predict(above, plane.row(y), x));
        differences.push_back(static_cast<char>(difference << 1 ^ (difference >= 128 ? 255 : 0)));
      }
      if ((y + 1) % kRowsPerPiece != 0 && y + 1 != plane.height()) continue;
      writer.Packed(differences);
      differences.clear();
    }
  }
  return writer.Take();
}

class LosslessImage : public testing::TestWithParam<std::tuple<Content, int, int, bool>> {};

TEST_P(LosslessImage, HasTheBytesOfTheDocumentAndComesBackAsItWas) {
  const auto& [content, width, height, gray] = GetParam();
  const ColorImage image = Draw(content, width, height, gray);
  const Result<std::string> bytes = EncodeLosslessImage(image);
  ASSERT_TRUE(bytes) << bytes.error().message;
  EXPECT_EQ(*bytes, EncodedPlainly(image));
  const Result<ColorImage> back = DecodeLosslessImage(*bytes);
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(*back, image);
}

INSTANTIATE_TEST_SUITE_P(Contents, LosslessImage,
                         testing::Combine(testing::Values(Content::kFlat, Content::kNoise,
                                                          Content::kRamp, Content::kEdges),
                                          testing::Values(1, 2, 3, 67), testing::Values(1, 2, 70),
                                          testing::Bool()));

}  // namespace
}  // namespace foresight
