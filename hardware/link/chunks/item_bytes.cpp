#include "hardware/link/chunks/item_bytes.h"

#include <zstd.h>

#include <bit>
#include <memory>

namespace foresight {
namespace {

// Higher levels gain nothing on differences, which are mostly noise.
constexpr int kZstdLevel = 1;

/// Makes its tables once a thread and not once a call.
ZSTD_CCtx* Compressor() {
  struct Free {
    void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
  };
  thread_local const std::unique_ptr<ZSTD_CCtx, Free> context(ZSTD_createCCtx());
  return context.get();
}

ZSTD_DCtx* Decompressor() {
  struct Free {
    void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
  };
  thread_local const std::unique_ptr<ZSTD_DCtx, Free> context(ZSTD_createDCtx());
  return context.get();
}

/// Empty where zstd does not help.
std::string Compress(std::string_view bytes) {
  ZSTD_CCtx* const context = Compressor();
  if (context == nullptr || bytes.empty()) return {};
  ZSTD_CCtx_reset(context, ZSTD_reset_session_and_parameters);
  ZSTD_CCtx_setParameter(context, ZSTD_c_compressionLevel, kZstdLevel);
  ZSTD_CCtx_setParameter(context, ZSTD_c_contentSizeFlag, 0);  // the reader knows it
  std::string packed(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size =
      ZSTD_compress2(context, packed.data(), packed.size(), bytes.data(), bytes.size());
  if (ZSTD_isError(size) != 0 || size >= bytes.size()) return {};
  packed.resize(size);
  return packed;
}

template <class T>
void AppendLittleEndian(std::string& bytes, T value) {
  for (std::size_t i = 0; i < sizeof value; ++i)
    bytes.push_back(static_cast<char>(value >> (8 * i) & 0xff));
}

template <class T>
T FromLittleEndian(std::string_view bytes) {
  T value = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i)
    value |= static_cast<T>(static_cast<T>(static_cast<unsigned char>(bytes[i])) << (8 * i));
  return value;
}

}  // namespace

ItemWriter& ItemWriter::U8(std::uint8_t value) {
  bytes_.push_back(static_cast<char>(value));
  return *this;
}

ItemWriter& ItemWriter::U32(std::uint32_t value) {
  AppendLittleEndian(bytes_, value);
  return *this;
}

ItemWriter& ItemWriter::U64(std::uint64_t value) {
  AppendLittleEndian(bytes_, value);
  return *this;
}

ItemWriter& ItemWriter::Varint(std::uint64_t value) {
  for (; value >= 0x80; value >>= 7) bytes_.push_back(static_cast<char>((value & 0x7f) | 0x80));
  bytes_.push_back(static_cast<char>(value));
  return *this;
}

ItemWriter& ItemWriter::Double(double value) {
  return U64(std::bit_cast<std::uint64_t>(value));
}

ItemWriter& ItemWriter::Float(float value) {
  return U32(std::bit_cast<std::uint32_t>(value));
}

ItemWriter& ItemWriter::Text(std::string_view text) {
  return Varint(text.size()).Raw(text);
}

ItemWriter& ItemWriter::Raw(std::string_view bytes) {
  bytes_ += bytes;
  return *this;
}

ItemWriter& ItemWriter::Packed(std::string_view bytes) {
  const std::string packed = Compress(bytes);
  return packed.empty() ? Varint(0).Raw(bytes) : Varint(packed.size()).Raw(packed);
}

std::uint8_t ItemReader::U8() {
  return FromLittleEndian<std::uint8_t>(Raw(1));
}

std::uint32_t ItemReader::U32() {
  return FromLittleEndian<std::uint32_t>(Raw(4));
}

std::uint64_t ItemReader::U64() {
  return FromLittleEndian<std::uint64_t>(Raw(8));
}

std::uint64_t ItemReader::Varint() {
  std::uint64_t value = 0;
  for (unsigned shift = 0; shift < 64; shift += 7) {
    const std::uint8_t byte = U8();
    if (!ok_) return 0;
    if (shift == 63 && byte > 1) break;
    value |= std::uint64_t{byte & 0x7fU} << shift;
    if ((byte & 0x80) == 0) return value;
  }
  SetFailed();
  return 0;
}

double ItemReader::Double() {
  return std::bit_cast<double>(U64());
}

float ItemReader::Float() {
  return std::bit_cast<float>(U32());
}

std::string_view ItemReader::Text() {
  return Raw(Count(left_.size()));
}

std::string_view ItemReader::Raw(std::size_t size) {
  if (size > left_.size()) {
    SetFailed();
    return {};
  }
  const std::string_view bytes = left_.substr(0, size);
  left_.remove_prefix(size);
  return bytes;
}

std::string ItemReader::Packed(std::size_t size) {
  const std::uint64_t packed_size = Count(left_.size());
  if (!ok_) return {};
  if (packed_size == 0) return std::string(Raw(size));
  const std::string_view packed = Raw(packed_size);
  std::string bytes(size, '\0');
  ZSTD_DCtx* const context = Decompressor();
  // Writes at most `size` bytes, whatever the frame claims.
  if (context == nullptr || ZSTD_decompressDCtx(context, bytes.data(), bytes.size(), packed.data(),
                                                packed.size()) != size) {
    SetFailed();
    return {};
  }
  return bytes;
}

std::uint64_t ItemReader::Count(std::uint64_t most) {
  const std::uint64_t count = Varint();
  if (count <= most) return count;
  SetFailed();
  return 0;
}

Status ItemReader::Finish(const char* what) const {
  if (!ok_) return Fail(ErrorCode::kBadData, "{}: the item is damaged or ends early", what);
  if (!left_.empty())
    return Fail(ErrorCode::kBadData, "{}: {} bytes follow the item's end", what, left_.size());
  return {};
}

void AppendEvenDoubles(ItemWriter& writer, std::span<const double> values) {
  std::uint64_t before = 0, step = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto bits = std::bit_cast<std::uint64_t>(values[i]);
    const std::uint64_t next_step = bits - before;
    if (i == 0)
      writer.U64(bits);
    else
      writer.Signed(static_cast<std::int64_t>(next_step - step));
    step = i == 0 ? 0 : next_step;
    before = bits;
  }
}

std::vector<double> ReadEvenDoubles(ItemReader& reader, std::size_t count) {
  std::vector<double> values;
  std::uint64_t bits = 0, step = 0;
  for (std::size_t i = 0; i < count && reader.ok(); ++i) {
    if (i == 0) {
      bits = reader.U64();
    } else {
      step += static_cast<std::uint64_t>(reader.Signed());
      bits += step;
    }
    values.push_back(std::bit_cast<double>(bits));
  }
  return values;
}

}  // namespace foresight
