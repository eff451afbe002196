#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace foresight {

/// Small differences of either sign become small numbers.
constexpr std::uint64_t Zigzag(std::int64_t value) {
  return static_cast<std::uint64_t>(value) << 1 ^ static_cast<std::uint64_t>(value >> 63);
}
constexpr std::int64_t Unzigzag(std::uint64_t value) {
  return static_cast<std::int64_t>(value >> 1 ^ (~(value & 1) + 1));
}

/// Builds an item's bytes; numbers are little-endian.
class ItemWriter {
 public:
  ItemWriter& U8(std::uint8_t value);
  ItemWriter& U32(std::uint32_t value);
  ItemWriter& U64(std::uint64_t value);
  ItemWriter& Varint(std::uint64_t value);  ///< 7 bits a byte, low ones first
  ItemWriter& Signed(std::int64_t value) { return Varint(Zigzag(value)); }
  ItemWriter& Double(double value);  ///< all bits
  ItemWriter& Float(float value);
  ItemWriter& Text(std::string_view text);  ///< its length first
  ItemWriter& Raw(std::string_view bytes);
  /// Compressed by zstd where that is shorter; the reader knows how many bytes there are.
  ItemWriter& Packed(std::string_view bytes);

  std::string Take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Reads what ItemWriter wrote; bytes are not trusted. After the first failure everything reads as
/// 0 or empty, so a reader checks once, before it uses a number.
class ItemReader {
 public:
  explicit ItemReader(std::string_view bytes) : left_(bytes) {}

  std::uint8_t U8();
  std::uint32_t U32();
  std::uint64_t U64();
  std::uint64_t Varint();
  std::int64_t Signed() { return Unzigzag(Varint()); }
  double Double();
  float Float();
  std::string_view Text();
  std::string_view Raw(std::size_t size);
  /// `size` bytes; takes no memory where the packed ones are not there.
  std::string Packed(std::size_t size);
  /// A varint of at most `most`; a larger one is a failure.
  std::uint64_t Count(std::uint64_t most);

  bool ok() const { return ok_; }
  std::size_t left() const { return left_.size(); }
  /// Fails with kBadData, naming `what`, unless everything was read and nothing is left.
  Status Finish(const char* what) const;
  void SetFailed() {
    ok_ = false;
    left_ = {};
  }

 private:
  std::string_view left_;
  bool ok_ = true;
};

/// Doubles to the last bit, a few bytes each where they grow evenly.
void AppendEvenDoubles(ItemWriter& writer, std::span<const double> values);
std::vector<double> ReadEvenDoubles(ItemReader& reader, std::size_t count);

}  // namespace foresight
