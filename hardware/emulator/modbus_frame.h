#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace foresight {

/// The 16-bit registers of an emulated device.
class RegisterBank {
 public:
  virtual ~RegisterBank() = default;
  /// nullopt when one of them is not there.
  virtual std::optional<std::vector<std::uint16_t>> Read(std::uint16_t first,
                                                         std::uint16_t count) = 0;
  /// Writes all or nothing; false when one of them cannot be written.
  virtual bool Write(std::uint16_t first, std::span<const std::uint16_t> values) = 0;
};

namespace modbus {

/// How many bytes the frame at the front of a stream has (MBAP header and PDU); 0: more bytes are
/// needed to tell; nullopt: this is no Modbus TCP, close the connection.
std::optional<std::size_t> FrameLength(std::span<const std::uint8_t> stream);

/// The answer to one whole request, by the specification's functions 03, 04, 06, 10h and 17h;
/// exception 01 for others, 02 for registers that are not there, 03 for counts and lengths that do
/// not fit.
std::vector<std::uint8_t> Answer(std::span<const std::uint8_t> request, RegisterBank& bank);

}  // namespace modbus
}  // namespace foresight
