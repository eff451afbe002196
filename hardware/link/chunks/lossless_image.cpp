#include "hardware/link/chunks/lossless_image.h"

#include <algorithm>
#include <array>

#include "core/base/gray_image.h"
#include "core/io/image_limits.h"
#include "hardware/link/chunks/grid_predictor.h"
#include "hardware/link/chunks/item_bytes.h"

namespace foresight {
namespace {

constexpr std::uint8_t kLosslessForm = 1;
// zstd describes the frequencies of bytes once a piece; they change over an image.
constexpr int kRowsPerPiece = 32;
// Neighbours that differ by less are noise: found by trial on images of the room scene.
constexpr int kSmoothLevel = 6;

std::uint8_t Zigzag8(int difference) {
  const auto bits = static_cast<std::uint8_t>(difference);
  return static_cast<std::uint8_t>(bits << 1 ^ -(bits >> 7));
}

int Unzigzag8(unsigned value) {
  return static_cast<int>(value >> 1 ^ (~(value & 1) + 1));
}

std::span<const std::uint8_t> RowOf(const GrayImage& image, int y) {
  if (y < 0) return {};
  return {image.row(y), static_cast<std::size_t>(image.width())};
}

constexpr std::int16_t Narrow(int value) {
  return static_cast<std::int16_t>(value);
}

/// What GridPredictor expects of a value with neighbours on all sides: without branches and in 16
/// bits, so that the compiler makes vectors of it.
[[gnu::always_inline]] inline std::int16_t Expected(std::int16_t left, std::int16_t up_left,
                                                    std::int16_t up, std::int16_t up_right) {
  const std::int16_t low = std::min(left, up), high = std::max(left, up);
  const std::int16_t spread = Narrow(std::max(high, std::max(up_left, up_right)) -
                                     std::min(low, std::min(up_left, up_right)));
  const std::int16_t mean = Narrow((3 * left + 3 * up + up_right + up_left + 4) >> 3);
  const std::int16_t sum = Narrow(2 * left + 2 * up + up_right - up_left + 2);
  const std::int16_t slope = Narrow((sum + ((sum >> 15) & 3)) >> 2);  // towards zero, as / 4 is
  const std::int16_t edge = std::max(low, std::min(high, Narrow(left + up - up_left)));
  return spread < kSmoothLevel ? mean : spread < 3 * kSmoothLevel ? slope : edge;
}

/// The differences of a row, of the size of `row`.
void AppendDifferences(std::span<const std::uint8_t> above, std::span<const std::uint8_t> row,
                       std::uint8_t* differences) {
  const GridPredictor predictor(kSmoothLevel);
  const auto by_hand = [&](std::size_t x) {
    differences[x] = Zigzag8(row[x] - predictor.Predict(above, row.data(), x));
  };
  const std::size_t size = row.size();
  if (above.empty() || size < 3) {
    for (std::size_t x = 0; x < size; ++x) by_hand(x);
    return;
  }
  by_hand(0);
  const std::uint8_t* const up = above.data();
  const std::uint8_t* const here = row.data();
  for (std::size_t x = 1; x + 1 < size; ++x) {
    const std::int16_t expected = Expected(here[x - 1], up[x - 1], up[x], up[x + 1]);
    differences[x] = Zigzag8(here[x] - expected);
  }
  by_hand(size - 1);
}

void AppendPlane(ItemWriter& writer, const GrayImage& plane) {
  const auto columns = static_cast<std::size_t>(plane.width());
  std::string differences;
  for (int y = 0; y < plane.height(); y += kRowsPerPiece) {
    const int rows = std::min(kRowsPerPiece, plane.height() - y);
    differences.resize(columns * static_cast<std::size_t>(rows));
    auto* next = reinterpret_cast<std::uint8_t*>(differences.data());
    for (int row = y; row < y + rows; ++row, next += columns)
      AppendDifferences(RowOf(plane, row - 1), RowOf(plane, row), next);
    writer.Packed(differences);
  }
}

GrayImage ReadPlane(ItemReader& reader, int width, int height) {
  // A plane takes memory piece by piece, as the bytes are there.
  const GridPredictor predictor(kSmoothLevel);
  const auto columns = static_cast<std::size_t>(width);
  std::vector<std::string> pieces;
  for (int y = 0; y < height && reader.ok(); y += kRowsPerPiece)
    pieces.push_back(
        reader.Packed(columns * static_cast<std::size_t>(std::min(kRowsPerPiece, height - y))));
  if (!reader.ok()) return {};
  GrayImage plane(width, height);
  for (int y = 0; y < height; ++y) {
    const std::string& piece = pieces[static_cast<std::size_t>(y / kRowsPerPiece)];
    const char* differences = piece.data() + columns * static_cast<std::size_t>(y % kRowsPerPiece);
    const auto above = RowOf(plane, y - 1);
    std::uint8_t* row = plane.row(y);
    for (std::size_t x = 0; x < columns; ++x)
      row[x] = static_cast<std::uint8_t>(predictor.Predict(above, row, x) +
                                         Unzigzag8(static_cast<unsigned char>(differences[x])));
  }
  return plane;
}

/// Differences between the colours would have the noise of both.
std::array<GrayImage, 3> PlanesOf(const ColorImage& image) {
  std::array<GrayImage, 3> planes;
  for (GrayImage& plane : planes) plane = GrayImage(image.width(), image.height());
  for (std::size_t i = 0; i < image.size(); ++i) {
    const Rgb8& pixel = image.values()[i];
    planes[0].values()[i] = pixel.r;
    planes[1].values()[i] = pixel.g;
    planes[2].values()[i] = pixel.b;
  }
  return planes;
}

ColorImage ImageOf(const std::array<GrayImage, 3>& planes) {
  ColorImage image(planes[0].width(), planes[0].height());
  for (std::size_t i = 0; i < image.size(); ++i)
    image.values()[i] = {planes[0].values()[i], planes[1].values()[i], planes[2].values()[i]};
  return image;
}

}  // namespace

Result<std::string> EncodeLosslessImage(const ColorImage& image) {
  if (static_cast<std::int64_t>(image.size()) > kMostImagePixels || image.width() > kMaxImageSide ||
      image.height() > kMaxImageSide)
    return Fail(ErrorCode::kInvalidInput, "an image of {} x {} is more than {} a side or {} pixels",
                image.width(), image.height(), kMaxImageSide, kMostImagePixels);
  ItemWriter writer;
  writer.U8(kLosslessForm);
  writer.Varint(static_cast<std::uint64_t>(image.width()));
  writer.Varint(static_cast<std::uint64_t>(image.height()));
  const bool gray = IsGray(image);
  writer.U8(gray ? 1 : 3);
  if (gray) {
    AppendPlane(writer, RedOf(image));
  } else {
    for (const GrayImage& plane : PlanesOf(image)) AppendPlane(writer, plane);
  }
  return writer.Take();
}

Result<ColorImage> DecodeLosslessImage(std::string_view bytes) {
  ItemReader reader(bytes);
  if (reader.U8() != kLosslessForm) return Fail(ErrorCode::kBadData, "image: form is not known");
  const int width = static_cast<int>(reader.Count(kMaxImageSide));
  const int height = static_cast<int>(reader.Count(kMaxImageSide));
  const std::uint8_t planes = reader.U8();
  if (std::int64_t{width} * height > kMostImagePixels || (planes != 1 && planes != 3))
    return Fail(ErrorCode::kBadData, "image: {} x {} pixels of {} planes", width, height, planes);
  std::array<GrayImage, 3> read;
  for (std::size_t i = 0; i < planes && reader.ok(); ++i)
    read[i] = ReadPlane(reader, width, height);
  FORESIGHT_CHECK(reader.Finish("image"));
  return planes == 1 ? ColorOf(read[0]) : ImageOf(read);
}

}  // namespace foresight
