// The stream protocol of GigE Vision, byte by byte, and images cut into packets.
#include <gtest/gtest.h>

#include "core/base/random.h"
#include "hardware/emulator/gvsp_ring.h"

namespace foresight {
namespace {

using Bytes = std::vector<std::uint8_t>;
using gvsp::PixelFormat;

TEST(GvspCodec, ALeaderTellsWhenAndWhat) {
  const gvsp::Leader leader{0x0000000123456789, PixelFormat::kRGB8, 1288, 964};
  const Bytes bytes = {
      0x00, 0x00, 0x00, 0x05, 0x01, 0x00, 0x00, 0x00,  // status, block, leader, packet 0
      0x00, 0x00, 0x00, 0x01,                          // reserved, an image
      0x00, 0x00, 0x00, 0x01, 0x23, 0x45, 0x67, 0x89,  // time stamp
      0x02, 0x18, 0x00, 0x14,                          // RGB8
      0x00, 0x00, 0x05, 0x08, 0x00, 0x00, 0x03, 0xC4,  // width, height
      0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,  // offsets
      0x00, 0x00, 0x00, 0x00,                          // paddings
  };
  EXPECT_EQ(gvsp::EncodeLeader(5, leader), bytes);
  const auto packet = gvsp::DecodePacket(bytes);
  ASSERT_TRUE(packet);
  EXPECT_EQ(gvsp::DecodeLeader(*packet), leader);
}

TEST(GvspCodec, APayloadPacketIsNumberedIn24Bits) {
  const Bytes data = {1, 2, 3};
  const Bytes bytes = {0, 0, 0xFF, 0xFF, 0x03, 0x01, 0x02, 0x03, 1, 2, 3};
  EXPECT_EQ(gvsp::EncodePayload(0xFFFF, 0x010203, data), bytes);
  const auto packet = gvsp::DecodePacket(bytes);
  ASSERT_TRUE(packet);
  EXPECT_EQ(packet->number, 0x010203u);
  EXPECT_EQ(Bytes(packet->payload.begin(), packet->payload.end()), data);
}

TEST(GvspCodec, ATrailerEndsTheBlock) {
  EXPECT_EQ(gvsp::EncodeTrailer(1, 912, 964),
            (Bytes{0, 0, 0, 1, 0x02, 0x00, 0x03, 0x90, 0, 0, 0, 1, 0, 0, 0x03, 0xC4}));
}

TEST(GvspCodec, OtherBytesAreNoPacketOfAnImage) {
  EXPECT_FALSE(gvsp::DecodePacket(Bytes(7)));
  EXPECT_FALSE(gvsp::DecodePacket(Bytes(1372)));  // a test packet
}

GvspFrame FullFrame(std::size_t packet_bytes) {
  GvspFrame frame;
  frame.leader = {0, PixelFormat::kMono8, 1288, 964};
  frame.pixels.resize(1288 * 964);
  Random random(1);
  for (auto& pixel : frame.pixels) pixel = static_cast<std::uint8_t>(random.Next());
  frame.payload_bytes = packet_bytes - gvsp::kOverheadBytes;
  return frame;
}

TEST(GvspFrames, HaveAsManyPacketsAsMeasuredOnTheWire) {
  EXPECT_EQ(FullFrame(1400).PacketCount(), 913u);
  EXPECT_EQ(FullFrame(8000).PacketCount(), 158u);
}

TEST(GvspFrames, PayloadsTogetherAreThePixels) {
  const GvspFrame frame = FullFrame(1400);
  Bytes pixels;
  for (std::uint32_t number = 1; number + 1 < frame.PacketCount(); ++number) {
    const Bytes bytes = frame.Packet(number);
    EXPECT_LE(bytes.size() + 28, 1400u);
    const auto packet = gvsp::DecodePacket(bytes);
    ASSERT_TRUE(packet);
    EXPECT_EQ(packet->number, number);
    pixels.insert(pixels.end(), packet->payload.begin(), packet->payload.end());
  }
  EXPECT_EQ(pixels, frame.pixels);
  EXPECT_EQ(gvsp::DecodePacket(frame.Packet(0))->kind, gvsp::PacketKind::kLeader);
  EXPECT_EQ(gvsp::DecodePacket(frame.Packet(912))->kind, gvsp::PacketKind::kTrailer);
}

TEST(GvspRing, RemembersTheLastFour) {
  GvspRing ring;
  for (std::uint16_t block = 1; block <= 6; ++block) {
    auto frame = std::make_shared<GvspFrame>();
    frame->block = block;
    ring.Add(frame);
  }
  EXPECT_EQ(ring.Find(2), nullptr);
  for (std::uint16_t block = 3; block <= 6; ++block) {
    ASSERT_NE(ring.Find(block), nullptr);
    EXPECT_EQ(ring.Find(block)->block, block);
  }
  ring.Clear();
  EXPECT_EQ(ring.Find(6), nullptr);
}

TEST(EncodePixels, AMosaicBeginsWithRed) {
  const ColorImage image(2, 2, Rgb8{10, 20, 30});
  EXPECT_EQ(EncodePixels(image, PixelFormat::kBayerRG8), (Bytes{10, 20, 20, 30}));
}

TEST(EncodePixels, AGreyPixelStaysAsItIs) {
  for (const int value : {0, 1, 127, 254, 255}) {
    const auto grey = static_cast<std::uint8_t>(value);
    EXPECT_EQ(EncodePixels(ColorImage(1, 1, {grey, grey, grey}), PixelFormat::kMono8), Bytes{grey});
  }
}

}  // namespace
}  // namespace foresight
