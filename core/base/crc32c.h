#pragma once

#include <cstdint>
#include <string_view>

namespace foresight {

/// CRC-32C (Castagnoli; iSCSI, ext4) of bytes that may come in pieces: the CRC of "ab" is
/// Crc32c("b", Crc32c("a")). 1 ns a byte.
std::uint32_t Crc32c(std::string_view bytes, std::uint32_t crc_before = 0);

}  // namespace foresight
