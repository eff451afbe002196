#include "core/base/crc32c.h"

#include <array>
#include <cstddef>

namespace foresight {
namespace {

constexpr std::uint32_t kPolynomial = 0x82F63B78;  ///< bits reversed

/// table[k][b]: what byte b does to the CRC, k bytes before the end of a group of eight.
using Tables = std::array<std::array<std::uint32_t, 256>, 8>;

constexpr Tables MakeTables() {
  Tables tables{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t crc = byte;
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ ((crc & 1) != 0 ? kPolynomial : 0);
    tables[0][byte] = crc;
  }
  for (std::size_t k = 1; k < tables.size(); ++k)
    for (std::size_t byte = 0; byte < 256; ++byte) {
      const std::uint32_t crc = tables[k - 1][byte];
      tables[k][byte] = crc >> 8 ^ tables[0][crc & 0xff];
    }
  return tables;
}

constexpr Tables kTables = MakeTables();

}  // namespace

std::uint32_t Crc32c(std::string_view bytes, std::uint32_t crc_before) {
  std::uint32_t crc = ~crc_before;
  const auto* at = reinterpret_cast<const unsigned char*>(bytes.data());
  std::size_t left = bytes.size();
  for (; left >= 8; at += 8, left -= 8) {
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < 4; ++i) next ^= kTables[7 - i][(crc >> (8 * i) & 0xff) ^ at[i]];
    for (std::size_t i = 4; i < 8; ++i) next ^= kTables[7 - i][at[i]];
    crc = next;
  }
  for (; left > 0; ++at, --left) crc = crc >> 8 ^ kTables[0][(crc & 0xff) ^ *at];
  return ~crc;
}

}  // namespace foresight
