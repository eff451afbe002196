#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace foresight {

/// Appends the lowest `bytes` bytes of `value`, the highest of them first.
inline void AppendBigEndian(std::vector<std::uint8_t>& out, std::uint64_t value, int bytes) {
  for (int i = bytes - 1; i >= 0; --i) out.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

/// The number in `bytes` bytes at `at`; the caller has seen that they are there.
inline std::uint64_t BigEndianAt(std::span<const std::uint8_t> from, std::size_t at, int bytes) {
  std::uint64_t value = 0;
  for (int i = 0; i < bytes; ++i) value = value << 8U | from[at + static_cast<std::size_t>(i)];
  return value;
}

inline std::uint16_t BigEndian16(std::span<const std::uint8_t> from, std::size_t at) {
  return static_cast<std::uint16_t>(BigEndianAt(from, at, 2));
}
inline std::uint32_t BigEndian24(std::span<const std::uint8_t> from, std::size_t at) {
  return static_cast<std::uint32_t>(BigEndianAt(from, at, 3));
}
inline std::uint32_t BigEndian32(std::span<const std::uint8_t> from, std::size_t at) {
  return static_cast<std::uint32_t>(BigEndianAt(from, at, 4));
}

}  // namespace foresight
