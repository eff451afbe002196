#pragma once

#include <cstdint>
#include <string_view>

namespace foresight {

/// CRC-32 over everything that a row of the mission file holds, its keys included: SQLite does not
/// notice a flipped bit inside a value, and a row that lands under another key is as wrong as one
/// whose data is damaged.
class RowChecksum {
 public:
  RowChecksum& Add(std::int64_t value);
  /// SQLite keeps neither the sign of a zero nor the kind of a NaN, so neither is covered.
  RowChecksum& Add(double value);
  /// The length is covered too, so that text cannot move between two neighbouring columns.
  RowChecksum& Add(std::string_view bytes);

  std::int64_t value() const { return static_cast<std::int64_t>(crc_); }

 private:
  void AddBytes(const void* bytes, std::size_t size);

  std::uint32_t crc_ = 0;
};

}  // namespace foresight
