#include "hardware/emulator/gvsp_codec.h"

#include "hardware/emulator/big_endian.h"

namespace foresight::gvsp {
namespace {

constexpr std::uint32_t kImagePayload = 1;
constexpr std::size_t kLeaderBytes = 36;

std::vector<std::uint8_t> Header(std::uint16_t block, PacketKind kind, std::uint32_t number) {
  std::vector<std::uint8_t> packet;
  AppendBigEndian(packet, 0, 2);
  AppendBigEndian(packet, block, 2);
  AppendBigEndian(packet, static_cast<std::uint8_t>(kind), 1);
  AppendBigEndian(packet, number, 3);
  return packet;
}

}  // namespace

int BytesPerPixel(PixelFormat format) {
  switch (format) {
    case PixelFormat::kMono8:
    case PixelFormat::kBayerRG8:
      return 1;
    case PixelFormat::kRGB8:
      return 3;
  }
  return 0;
}

std::vector<std::uint8_t> EncodeLeader(std::uint16_t block, const Leader& leader) {
  std::vector<std::uint8_t> packet = Header(block, PacketKind::kLeader, 0);
  AppendBigEndian(packet, kImagePayload, 4);
  AppendBigEndian(packet, leader.timestamp, 8);
  AppendBigEndian(packet, static_cast<std::uint32_t>(leader.format), 4);
  AppendBigEndian(packet, leader.width, 4);
  AppendBigEndian(packet, leader.height, 4);
  AppendBigEndian(packet, 0, 8);  // offsets of the region
  AppendBigEndian(packet, 0, 4);  // paddings
  return packet;
}

std::vector<std::uint8_t> EncodePayload(std::uint16_t block, std::uint32_t number,
                                        std::span<const std::uint8_t> data) {
  std::vector<std::uint8_t> packet = Header(block, PacketKind::kPayload, number);
  packet.insert(packet.end(), data.begin(), data.end());
  return packet;
}

std::vector<std::uint8_t> EncodeTrailer(std::uint16_t block, std::uint32_t number,
                                        std::uint32_t height) {
  std::vector<std::uint8_t> packet = Header(block, PacketKind::kTrailer, number);
  AppendBigEndian(packet, kImagePayload, 4);
  AppendBigEndian(packet, height, 4);
  return packet;
}

std::optional<Packet> DecodePacket(std::span<const std::uint8_t> packet) {
  if (packet.size() < kHeaderBytes || packet[4] < 1 || packet[4] > 3) return std::nullopt;
  return Packet{BigEndian16(packet, 0), BigEndian16(packet, 2), static_cast<PacketKind>(packet[4]),
                BigEndian24(packet, 5), packet.subspan(kHeaderBytes)};
}

std::optional<Leader> DecodeLeader(const Packet& packet) {
  if (packet.kind != PacketKind::kLeader || packet.payload.size() != kLeaderBytes ||
      BigEndian16(packet.payload, 2) != kImagePayload)
    return std::nullopt;
  return Leader{BigEndianAt(packet.payload, 4, 8),
                static_cast<PixelFormat>(BigEndian32(packet.payload, 12)),
                BigEndian32(packet.payload, 16), BigEndian32(packet.payload, 20)};
}

}  // namespace foresight::gvsp
