#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

/// GVSP, the stream protocol of GigE Vision: an image is a block of a leader (packet 0), payload
/// packets and a trailer, each a UDP packet. Numbers are big endian.
namespace foresight::gvsp {

/// IP, UDP and GVSP headers: what a packet size of the stream register includes beside the payload.
inline constexpr std::size_t kOverheadBytes = 20 + 8 + 8;
inline constexpr std::size_t kHeaderBytes = 8;

/// Values of the GenICam pixel format naming convention.
enum class PixelFormat : std::uint32_t {
  kMono8 = 0x01080001,
  kBayerRG8 = 0x01080009,
  kRGB8 = 0x02180014,
};
/// 1 or 3; 0 for a value that is none of them.
int BytesPerPixel(PixelFormat format);

enum class PacketKind : std::uint8_t { kLeader = 1, kTrailer = 2, kPayload = 3 };

struct Leader {
  std::uint64_t timestamp = 0;  ///< ticks of the device
  PixelFormat format = PixelFormat::kMono8;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  bool operator==(const Leader&) const = default;
};

struct Packet {
  std::uint16_t status = 0;
  std::uint16_t block = 0;
  PacketKind kind = PacketKind::kPayload;
  std::uint32_t number = 0;  ///< 24 bits, 0 = the leader
  std::span<const std::uint8_t> payload;
};

std::vector<std::uint8_t> EncodeLeader(std::uint16_t block, const Leader& leader);
std::vector<std::uint8_t> EncodePayload(std::uint16_t block, std::uint32_t number,
                                        std::span<const std::uint8_t> data);
std::vector<std::uint8_t> EncodeTrailer(std::uint16_t block, std::uint32_t number,
                                        std::uint32_t height);

/// nullopt for anything that is no packet of an image. `payload` points into `packet`.
std::optional<Packet> DecodePacket(std::span<const std::uint8_t> packet);
std::optional<Leader> DecodeLeader(const Packet& packet);

}  // namespace foresight::gvsp
