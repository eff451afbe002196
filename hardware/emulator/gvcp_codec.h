#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

/// GVCP, the control protocol of GigE Vision: one UDP packet is one message. Numbers are big
/// endian. Bytes and messages, nothing else. Block ids have 16 bits (GigE Vision 1.2).
namespace foresight::gvcp {

inline constexpr std::uint16_t kPort = 3956;
inline constexpr std::size_t kHeaderBytes = 8;
inline constexpr std::size_t kLargestMemoryAccess = 536;  ///< bytes of one READMEM or WRITEMEM
inline constexpr std::size_t kDiscoveryBytes = 0xF8;  ///< of the registers, answered to DISCOVERY

/// An acknowledge has the command's number plus one.
enum class Command : std::uint16_t {
  kDiscovery = 0x0002,
  kPacketResend = 0x0040,  ///< has no acknowledge: the packets are the answer
  kReadRegister = 0x0080,
  kWriteRegister = 0x0082,
  kReadMemory = 0x0084,
  kWriteMemory = 0x0086,
};

enum class AckStatus : std::uint16_t {
  kSuccess = 0x0000,
  kNotImplemented = 0x8001,
  kInvalidParameter = 0x8002,
  kInvalidAddress = 0x8003,
  kWriteProtect = 0x8004,
  kBadAlignment = 0x8005,
  kAccessDenied = 0x8006,
};

struct Discovery {
  bool operator==(const Discovery&) const = default;
};
struct ReadRegisters {
  std::vector<std::uint32_t> addresses;
  bool operator==(const ReadRegisters&) const = default;
};
struct WriteRegisters {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> values;  ///< address, value
  bool operator==(const WriteRegisters&) const = default;
};
struct ReadMemory {
  std::uint32_t address = 0;
  std::uint16_t count = 0;  ///< bytes
  bool operator==(const ReadMemory&) const = default;
};
struct WriteMemory {
  std::uint32_t address = 0;
  std::vector<std::uint8_t> bytes;
  bool operator==(const WriteMemory&) const = default;
};
struct PacketResend {
  std::uint16_t channel = 0;
  std::uint16_t block = 0;
  std::uint32_t first = 0;  ///< 24 bits
  std::uint32_t last = 0;   ///< 24 bits, inclusive
  bool operator==(const PacketResend&) const = default;
};
/// A command that is none of the above, or whose payload does not fit it.
struct Refused {
  std::uint16_t command = 0;
  AckStatus why = AckStatus::kNotImplemented;
  bool operator==(const Refused&) const = default;
};

struct Request {
  std::uint16_t id = 0;  ///< never 0; its acknowledge carries the same
  bool wants_ack = true;
  std::variant<Discovery, ReadRegisters, WriteRegisters, ReadMemory, WriteMemory, PacketResend,
               Refused>
      body;
  bool operator==(const Request&) const = default;
};

struct Ack {
  AckStatus status = AckStatus::kSuccess;
  std::uint16_t command = 0;  ///< of the acknowledge, as sent
  std::uint16_t id = 0;
  std::vector<std::uint8_t> payload;
  bool operator==(const Ack&) const = default;
};

/// nullopt when the packet is no GVCP request: nothing is to be answered then.
std::optional<Request> DecodeRequest(std::span<const std::uint8_t> packet);
/// A Refused has no payload.
std::vector<std::uint8_t> EncodeRequest(const Request& request);

std::optional<Ack> DecodeAck(std::span<const std::uint8_t> packet);
std::vector<std::uint8_t> EncodeAck(const Ack& ack);
/// The command's number on the wire, without the acknowledge's plus one.
std::uint16_t CommandOf(const Request& request);

}  // namespace foresight::gvcp
