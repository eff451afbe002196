// Whatever comes over a camera's stream becomes an image or is dropped; what decodes encodes to
// what decodes to the same; any packet of an image can be sent again.
#include <cstddef>
#include <cstdint>
#include <span>

#include "hardware/emulator/gvsp_codec.h"
#include "hardware/emulator/gvsp_ring.h"
#include "hardware/gige/pixel_formats.h"
#include "tests/fuzz/require.h"

namespace {

using namespace foresight;
using Bytes = std::span<const std::uint8_t>;

void DecodePackets(Bytes bytes) {
  const auto packet = gvsp::DecodePacket(bytes);
  if (!packet) return;
  Require(packet->number < 1U << 24U && packet->payload.size() + gvsp::kHeaderBytes <= bytes.size(),
          "a packet lies within what came");
  if (const auto leader = gvsp::DecodeLeader(*packet)) {
    const auto again = gvsp::EncodeLeader(packet->block, *leader);
    Require(gvsp::DecodeLeader(*gvsp::DecodePacket(again)) == leader, "a leader is itself");
  }
}

void ReadPixels(Bytes bytes) {
  if (bytes.size() < 3) return;
  const auto format = static_cast<GigeCameraOptions::Format>(bytes[0] % 3);
  const auto image = ToColorImage(bytes.subspan(3), format, bytes[1], bytes[2]);
  if (image) Require(image->width() == bytes[1] && image->height() == bytes[2], "the size is kept");
}

/// The payloads of an image's packets are its pixels.
void CutImage(Bytes bytes) {
  if (bytes.size() < 4) return;
  GvspFrame frame;
  frame.block = bytes[0];
  frame.payload_bytes = 1U + bytes[1] % 64U;
  frame.leader.width = bytes[2];
  frame.leader.height = bytes[3];
  frame.pixels.assign(bytes.begin() + 4, bytes.end());
  std::vector<std::uint8_t> pixels;
  for (std::uint32_t number = 0; number < frame.PacketCount(); ++number) {
    const auto bytes_again = frame.Packet(number);
    const auto packet = gvsp::DecodePacket(bytes_again);
    Require(packet && packet->block == frame.block && packet->number == number,
            "a packet knows its image and its place");
    if (packet->kind == gvsp::PacketKind::kPayload)
      pixels.insert(pixels.end(), packet->payload.begin(), packet->payload.end());
  }
  Require(pixels == frame.pixels, "the packets hold all pixels");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const Bytes bytes(data, size);
  DecodePackets(bytes);
  ReadPixels(bytes);
  CutImage(bytes);
  return 0;
}
