#include "hardware/emulator/gvcp_codec.h"

#include "hardware/emulator/big_endian.h"

namespace foresight::gvcp {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::uint8_t kKey = 0x42;
constexpr std::uint8_t kAckWanted = 0x01;
constexpr std::uint32_t kPacketMask = 0xFFFFFF;

using Body = decltype(Request::body);

Body DecodeReadRegisters(Bytes payload) {
  ReadRegisters read;
  for (std::size_t at = 0; at < payload.size(); at += 4)
    read.addresses.push_back(BigEndian32(payload, at));
  return read;
}

Body DecodeWriteRegisters(Bytes payload) {
  WriteRegisters write;
  for (std::size_t at = 0; at < payload.size(); at += 8)
    write.values.emplace_back(BigEndian32(payload, at), BigEndian32(payload, at + 4));
  return write;
}

/// Two reserved bytes stand before the count.
Body DecodeReadMemory(Bytes payload) {
  return ReadMemory{BigEndian32(payload, 0), BigEndian16(payload, 6)};
}

Body DecodeWriteMemory(Bytes payload) {
  const Bytes data = payload.subspan(4);
  return WriteMemory{BigEndian32(payload, 0), {data.begin(), data.end()}};
}

/// The packet numbers stand in 32 bits each, of which the upper 8 are reserved.
Body DecodePacketResend(Bytes payload) {
  return PacketResend{BigEndian16(payload, 0), BigEndian16(payload, 2),
                      BigEndian32(payload, 4) & kPacketMask, BigEndian32(payload, 8) & kPacketMask};
}

Body DecodeBody(std::uint16_t command, Bytes payload) {
  const std::size_t size = payload.size();
  switch (static_cast<Command>(command)) {
    case Command::kDiscovery:
      if (size == 0) return Discovery{};
      break;
    case Command::kReadRegister:
      if (size > 0 && size % 4 == 0) return DecodeReadRegisters(payload);
      break;
    case Command::kWriteRegister:
      if (size > 0 && size % 8 == 0) return DecodeWriteRegisters(payload);
      break;
    case Command::kReadMemory:
      if (size == 8) return DecodeReadMemory(payload);
      break;
    case Command::kWriteMemory:
      if (size > 4 && size % 4 == 0 && size <= 4 + kLargestMemoryAccess)
        return DecodeWriteMemory(payload);
      break;
    case Command::kPacketResend:
      if (size == 12) return DecodePacketResend(payload);
      break;
    default:
      return Refused{command, AckStatus::kNotImplemented};
  }
  return Refused{command, AckStatus::kInvalidParameter};
}

struct PayloadWriter {
  std::vector<std::uint8_t>& out;

  void operator()(const Discovery&) const {}
  void operator()(const ReadRegisters& read) const {
    for (const std::uint32_t address : read.addresses) AppendBigEndian(out, address, 4);
  }
  void operator()(const WriteRegisters& write) const {
    for (const auto& [address, value] : write.values) {
      AppendBigEndian(out, address, 4);
      AppendBigEndian(out, value, 4);
    }
  }
  void operator()(const ReadMemory& read) const {
    AppendBigEndian(out, read.address, 4);
    AppendBigEndian(out, read.count, 4);
  }
  void operator()(const WriteMemory& write) const {
    AppendBigEndian(out, write.address, 4);
    out.insert(out.end(), write.bytes.begin(), write.bytes.end());
  }
  void operator()(const PacketResend& resend) const {
    AppendBigEndian(out, resend.channel, 2);
    AppendBigEndian(out, resend.block, 2);
    AppendBigEndian(out, resend.first & kPacketMask, 4);
    AppendBigEndian(out, resend.last & kPacketMask, 4);
  }
  void operator()(const Refused&) const {}
};

struct CommandNumber {
  static std::uint16_t Number(Command command) { return static_cast<std::uint16_t>(command); }
  std::uint16_t operator()(const Discovery&) const { return Number(Command::kDiscovery); }
  std::uint16_t operator()(const ReadRegisters&) const { return Number(Command::kReadRegister); }
  std::uint16_t operator()(const WriteRegisters&) const { return Number(Command::kWriteRegister); }
  std::uint16_t operator()(const ReadMemory&) const { return Number(Command::kReadMemory); }
  std::uint16_t operator()(const WriteMemory&) const { return Number(Command::kWriteMemory); }
  std::uint16_t operator()(const PacketResend&) const { return Number(Command::kPacketResend); }
  std::uint16_t operator()(const Refused& refused) const { return refused.command; }
};

}  // namespace

std::uint16_t CommandOf(const Request& request) {
  return std::visit(CommandNumber{}, request.body);
}

std::optional<Request> DecodeRequest(Bytes packet) {
  if (packet.size() < kHeaderBytes || packet[0] != kKey) return std::nullopt;
  Request request;
  request.wants_ack = (packet[1] & kAckWanted) != 0;
  request.id = BigEndian16(packet, 6);
  if (request.id == 0) return std::nullopt;
  const std::uint16_t command = BigEndian16(packet, 2);
  const Bytes payload = packet.subspan(kHeaderBytes);
  request.body = BigEndian16(packet, 4) == payload.size()
                     ? DecodeBody(command, payload)
                     : Body(Refused{command, AckStatus::kInvalidParameter});
  return request;
}

std::vector<std::uint8_t> EncodeRequest(const Request& request) {
  std::vector<std::uint8_t> payload;
  std::visit(PayloadWriter{payload}, request.body);
  std::vector<std::uint8_t> packet = {kKey, request.wants_ack ? kAckWanted : std::uint8_t{0}};
  AppendBigEndian(packet, CommandOf(request), 2);
  AppendBigEndian(packet, payload.size(), 2);
  AppendBigEndian(packet, request.id, 2);
  packet.insert(packet.end(), payload.begin(), payload.end());
  return packet;
}

std::optional<Ack> DecodeAck(Bytes packet) {
  if (packet.size() < kHeaderBytes || BigEndian16(packet, 4) != packet.size() - kHeaderBytes)
    return std::nullopt;
  const Bytes payload = packet.subspan(kHeaderBytes);
  return Ack{static_cast<AckStatus>(BigEndian16(packet, 0)),
             BigEndian16(packet, 2),
             BigEndian16(packet, 6),
             {payload.begin(), payload.end()}};
}

std::vector<std::uint8_t> EncodeAck(const Ack& ack) {
  std::vector<std::uint8_t> packet;
  AppendBigEndian(packet, static_cast<std::uint16_t>(ack.status), 2);
  AppendBigEndian(packet, ack.command, 2);
  AppendBigEndian(packet, ack.payload.size(), 2);
  AppendBigEndian(packet, ack.id, 2);
  packet.insert(packet.end(), ack.payload.begin(), ack.payload.end());
  return packet;
}

}  // namespace foresight::gvcp
