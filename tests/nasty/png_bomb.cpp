#include "tests/nasty/png_bomb.h"

#include <zlib.h>

#include <algorithm>
#include <cstdint>

namespace foresight::nasty {
namespace {

std::string BigEndian(std::uint32_t value) {
  return {static_cast<char>(value >> 24), static_cast<char>(value >> 16 & 0xff),
          static_cast<char>(value >> 8 & 0xff), static_cast<char>(value & 0xff)};
}

std::string Chunk(const std::string& type, const std::string& data) {
  const std::string body = type + data;
  const auto sum =
      crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
  return BigEndian(static_cast<std::uint32_t>(data.size())) + body +
         BigEndian(static_cast<std::uint32_t>(sum));
}

/// So many zeros, deflated piece by piece.
std::string DeflatedZeros(std::uint64_t count) {
  const std::string zeros(std::size_t{1} << 20, '\0');
  std::string packed, piece(std::size_t{1} << 16, '\0');
  z_stream stream{};
  if (deflateInit(&stream, 1) != Z_OK) return {};
  bool ended = false;
  while (!ended) {
    const auto next = static_cast<uInt>(std::min<std::uint64_t>(count, zeros.size()));
    count -= next;
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(zeros.data()));
    stream.avail_in = next;
    do {
      stream.next_out = reinterpret_cast<Bytef*>(piece.data());
      stream.avail_out = static_cast<uInt>(piece.size());
      ended = deflate(&stream, count == 0 ? Z_FINISH : Z_NO_FLUSH) == Z_STREAM_END;
      packed.append(piece, 0, piece.size() - stream.avail_out);
    } while (stream.avail_out == 0);
  }
  deflateEnd(&stream);
  return packed;
}

}  // namespace

std::string PngBomb(unsigned width, unsigned height, int bits, PngColor color, unsigned rows) {
  const std::uint64_t channels = color == PngColor::kRgbAlpha ? 4 : 1;
  const std::uint64_t row_bytes =
      1 + (std::uint64_t{width} * channels * static_cast<unsigned>(bits) + 7) / 8;
  const std::string header = BigEndian(width) + BigEndian(height) + static_cast<char>(bits) +
                             static_cast<char>(color) + std::string(3, '\0');
  std::string png = "\x89PNG\r\n\x1a\n" + Chunk("IHDR", header);
  if (color == PngColor::kPalette) png += Chunk("PLTE", std::string(3, '\0'));
  // A row that long is not made: its beginning is enough.
  const std::uint64_t bytes =
      std::min<std::uint64_t>(row_bytes * (rows == 0 ? height : rows), std::uint64_t{1} << 30);
  return png + Chunk("IDAT", DeflatedZeros(bytes)) + Chunk("IEND", "");
}

}  // namespace foresight::nasty
