#include "core/mission/row_checksum.h"

#include <zlib.h>

#include <array>
#include <bit>
#include <cmath>

namespace foresight {

void RowChecksum::AddBytes(const void* bytes, std::size_t size) {
  crc_ = static_cast<std::uint32_t>(crc32_z(crc_, static_cast<const Bytef*>(bytes), size));
}

RowChecksum& RowChecksum::Add(std::int64_t value) {
  std::array<unsigned char, 8> bytes{};
  for (std::size_t i = 0; i < bytes.size(); ++i)
    bytes[i] = static_cast<unsigned char>(static_cast<std::uint64_t>(value) >> (8 * i));
  AddBytes(bytes.data(), bytes.size());
  return *this;
}

RowChecksum& RowChecksum::Add(double value) {
  return Add(std::isnan(value) ? std::int64_t{-1} : std::bit_cast<std::int64_t>(value + 0.0));
}

RowChecksum& RowChecksum::Add(std::string_view bytes) {
  Add(static_cast<std::int64_t>(bytes.size()));
  AddBytes(bytes.data(), bytes.size());
  return *this;
}

}  // namespace foresight
