#include "hardware/link/chunks/lossless_image.h"

#include <array>

#include "core/base/gray_image.h"
#include "hardware/link/chunks/grid_predictor.h"
#include "hardware/link/chunks/item_bytes.h"

namespace foresight {
namespace {

constexpr std::uint8_t kForm = 1;
constexpr int kMaxSide = 20000;
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

void AppendPlane(ItemWriter& writer, const GrayImage& plane) {
  const GridPredictor predictor(kSmoothLevel);
  std::string differences;
  for (int y = 0; y < plane.height(); ++y) {
    const auto above = RowOf(plane, y - 1), row = RowOf(plane, y);
    for (std::size_t x = 0; x < row.size(); ++x)
      differences.push_back(
          static_cast<char>(Zigzag8(row[x] - predictor.Predict(above, row.data(), x))));
    if ((y + 1) % kRowsPerPiece != 0 && y + 1 != plane.height()) continue;
    writer.Packed(differences);
    differences.clear();
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
  if (static_cast<std::int64_t>(image.size()) > kMostImagePixels || image.width() > kMaxSide ||
      image.height() > kMaxSide)
    return Fail(ErrorCode::kInvalidInput, "an image of {} x {} is more than {} a side or {} pixels",
                image.width(), image.height(), kMaxSide, kMostImagePixels);
  ItemWriter writer;
  writer.U8(kForm);
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
  if (reader.U8() != kForm) return Fail(ErrorCode::kBadData, "image: form is not known");
  const int width = static_cast<int>(reader.Count(kMaxSide));
  const int height = static_cast<int>(reader.Count(kMaxSide));
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
