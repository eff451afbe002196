// The mind of the emulated camera: who may write what, and what it sets off.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>

#include "hardware/emulator/big_endian.h"
#include "hardware/emulator/camera_device.h"
#include "hardware/emulator/camera_xml.h"

namespace foresight {
namespace {

namespace at = camera_register;
using gvcp::AckStatus;

struct DeviceBench {
  gvcp::Ack Ask(decltype(gvcp::Request::body) body, const UdpPeer& from) {
    gvcp::Request request;
    request.id = ++id;
    request.body = std::move(body);
    return gvcp::DecodeAck(device.Answer(gvcp::EncodeRequest(request), from, now_s))
        .value_or(gvcp::Ack{AckStatus::kNotImplemented, 0, 0, {}});
  }
  AckStatus Write(std::uint32_t address, std::uint32_t value, const UdpPeer& from) {
    return Ask(gvcp::WriteRegisters{{{address, value}}}, from).status;
  }
  std::uint32_t Read(std::uint32_t address) {
    const gvcp::Ack ack = Ask(gvcp::ReadRegisters{{address}}, guest);
    EXPECT_EQ(ack.status, AckStatus::kSuccess);
    return ack.payload.size() == 4 ? BigEndian32(ack.payload, 0) : 0xDEAD;
  }
  void TakeControlAndStart() {
    EXPECT_EQ(Write(at::kControlPrivilege, 2, host), AckStatus::kSuccess);
    EXPECT_EQ(Write(at::kTriggerMode, 1, host), AckStatus::kSuccess);
    EXPECT_EQ(Write(at::kAcquisitionStart, 1, host), AckStatus::kSuccess);
  }

  UdpPeer host{0x7F000001, 40000};
  UdpPeer guest{0x7F000001, 40001};
  double now_s = 100.0;
  std::uint16_t id = 0;
  CameraDevice device{1288, 964, {}, 0x7F000002, {}, 100.0};
};

TEST(CameraDevice, TellsOfItselfWhenLookedFor) {
  DeviceBench bench;
  const gvcp::Ack ack = bench.Ask(gvcp::Discovery{}, bench.guest);
  EXPECT_EQ(ack.command, 0x0003);
  ASSERT_EQ(ack.payload.size(), 0xF8u);
  EXPECT_EQ(BigEndian32(ack.payload, 0x24), 0x7F000002u);
  EXPECT_STREQ(reinterpret_cast<const char*>(&ack.payload[0x48]), "Foresight");
  EXPECT_STREQ(reinterpret_cast<const char*>(&ack.payload[0xD8]), "C0000001");
}

TEST(CameraDevice, OneClientControlsAndAllMayRead) {
  DeviceBench bench;
  EXPECT_EQ(bench.Write(at::kTriggerMode, 1, bench.host), AckStatus::kAccessDenied);
  EXPECT_EQ(bench.Write(at::kControlPrivilege, 2, bench.host), AckStatus::kSuccess);
  EXPECT_EQ(bench.Write(at::kControlPrivilege, 2, bench.guest), AckStatus::kAccessDenied);
  EXPECT_EQ(bench.Write(at::kTriggerMode, 1, bench.guest), AckStatus::kAccessDenied);
  EXPECT_EQ(bench.Write(at::kTriggerMode, 1, bench.host), AckStatus::kSuccess);
  EXPECT_EQ(bench.Read(at::kControlPrivilege), 2u);
  EXPECT_EQ(bench.Write(at::kControlPrivilege, 0, bench.host), AckStatus::kSuccess);
  EXPECT_EQ(bench.Write(at::kControlPrivilege, 2, bench.guest), AckStatus::kSuccess);
}

TEST(CameraDevice, SilenceBeyondTheHeartbeatLosesControlAndEndsTheStream) {
  DeviceBench bench;
  bench.TakeControlAndStart();
  bench.now_s += 2.9;
  EXPECT_EQ(bench.Write(at::kControlPrivilege, 2, bench.guest), AckStatus::kAccessDenied);
  EXPECT_TRUE(bench.device.acquiring());
  // That somebody else asks is no heartbeat.
  bench.now_s += 0.2;
  EXPECT_EQ(bench.Read(at::kControlPrivilege), 0u);
  EXPECT_FALSE(bench.device.acquiring());
  EXPECT_EQ(bench.Write(at::kControlPrivilege, 2, bench.guest), AckStatus::kSuccess);
}

TEST(CameraDevice, AnyRequestOfTheControllerIsAHeartbeat) {
  DeviceBench bench;
  bench.TakeControlAndStart();
  for (int i = 0; i < 5; ++i) {
    bench.now_s += 2.0;
    EXPECT_EQ(bench.Ask(gvcp::ReadRegisters{{at::kControlPrivilege}}, bench.host).status,
              AckStatus::kSuccess);
  }
  EXPECT_TRUE(bench.device.acquiring());
}

TEST(CameraDevice, ARepeatedTriggerIsAnsweredTwiceAndTakesOneImage) {
  DeviceBench bench;
  bench.TakeControlAndStart();
  gvcp::Request trigger;
  trigger.id = 999;
  trigger.body = gvcp::WriteRegisters{{{at::kTriggerSoftware, 1}}};
  const auto packet = gvcp::EncodeRequest(trigger);
  const auto answer = bench.device.Answer(packet, bench.host, bench.now_s);
  EXPECT_EQ(bench.device.Answer(packet, bench.host, bench.now_s), answer);
  EXPECT_EQ(bench.device.TakeCommands().triggers, 1);
}

TEST(CameraDevice, TakesNoImageBeforeItAcquires) {
  DeviceBench bench;
  EXPECT_EQ(bench.Write(at::kControlPrivilege, 2, bench.host), AckStatus::kSuccess);
  EXPECT_EQ(bench.Write(at::kTriggerMode, 1, bench.host), AckStatus::kSuccess);
  EXPECT_EQ(bench.Write(at::kTriggerSoftware, 1, bench.host), AckStatus::kSuccess);
  EXPECT_EQ(bench.device.TakeCommands().triggers, 0);
}

TEST(CameraDevice, RegistersMayBeWrittenAsMemoryToo) {
  DeviceBench bench;
  bench.TakeControlAndStart();
  const auto written = bench.Ask(gvcp::WriteMemory{at::kTriggerSoftware, {0, 0, 0, 1}}, bench.host);
  EXPECT_EQ(written.status, AckStatus::kSuccess);
  EXPECT_EQ(bench.device.TakeCommands().triggers, 1);
}

TEST(CameraDevice, ExposureAndGainAreDoublesWithinTheirLimits) {
  DeviceBench bench;
  bench.TakeControlAndStart();
  const auto write = [&](std::uint32_t address, double value) {
    gvcp::WriteMemory memory{address, {}};
    AppendBigEndian(memory.bytes, std::bit_cast<std::uint64_t>(value), 8);
    return bench.Ask(memory, bench.host).status;
  };
  EXPECT_EQ(write(at::kExposureTime, 2500.0), AckStatus::kSuccess);
  EXPECT_EQ(write(at::kGain, 12.0), AckStatus::kSuccess);
  EXPECT_EQ(write(at::kGain, 30.0), AckStatus::kInvalidParameter);
  EXPECT_EQ(write(at::kExposureTime, std::nan("")), AckStatus::kInvalidParameter);
  const CameraExposure exposure = bench.device.Expose(5.0);
  EXPECT_DOUBLE_EQ(exposure.exposure_s, 0.0025);
  EXPECT_DOUBLE_EQ(exposure.gain_db, 12.0);
}

TEST(CameraDevice, ThePixelFormatDecidesTheSizeOfAnImage) {
  DeviceBench bench;
  EXPECT_EQ(bench.Read(at::kPayloadSize), 1288u * 964u * 3u);
  bench.TakeControlAndStart();
  EXPECT_EQ(bench.Write(at::kPixelFormat, 0x01080009, bench.host), AckStatus::kSuccess);
  EXPECT_EQ(bench.Read(at::kPayloadSize), 1288u * 964u);
  EXPECT_EQ(bench.Write(at::kPixelFormat, 0x01100007, bench.host), AckStatus::kInvalidParameter);
}

TEST(CameraDevice, RefusesByTheStandardsCodes) {
  DeviceBench bench;
  bench.TakeControlAndStart();
  EXPECT_EQ(bench.Write(at::kWidth, 100, bench.host), AckStatus::kWriteProtect);
  EXPECT_EQ(bench.Write(0x0FF0, 1, bench.host), AckStatus::kInvalidAddress);
  EXPECT_EQ(bench.Write(at::kGain + 2, 1, bench.host), AckStatus::kBadAlignment);
  EXPECT_EQ(bench.Write(at::kPacketSize, 100, bench.host), AckStatus::kInvalidParameter);
  EXPECT_EQ(bench.Ask(gvcp::ReadMemory{at::kXmlUrl, 540}, bench.host).status,
            AckStatus::kInvalidParameter);
}

TEST(CameraDevice, LatchesItsClockWhenAsked) {
  CameraFaults faults;
  faults.clock_start_s = 10.0;
  faults.clock_ppm = 100.0;
  DeviceBench bench;
  bench.device = CameraDevice(32, 24, {}, 1, faults, 100.0);
  bench.TakeControlAndStart();
  bench.now_s = 102.0;
  EXPECT_EQ(bench.Write(at::kTimestampControl, 2, bench.host), AckStatus::kSuccess);
  bench.now_s = 103.0;
  const std::uint64_t ticks = static_cast<std::uint64_t>(bench.Read(at::kTimestampHigh)) << 32U |
                              bench.Read(at::kTimestampLow);
  EXPECT_EQ(ticks, 12'000'200'000u);
}

TEST(CameraDevice, ItsDescriptionLiesWhereTheRegisterSays) {
  DeviceBench bench;
  const gvcp::Ack url = bench.Ask(gvcp::ReadMemory{at::kXmlUrl, 64}, bench.guest);
  ASSERT_GT(url.payload.size(), 4u);
  const std::string text(reinterpret_cast<const char*>(&url.payload[4]));
  EXPECT_THAT(text, testing::StartsWith("Local:///foresight_camera.xml;20000;"));
  const gvcp::Ack xml = bench.Ask(gvcp::ReadMemory{at::kXml, 512}, bench.guest);
  ASSERT_EQ(xml.payload.size(), 516u);
  EXPECT_EQ(std::string(xml.payload.begin() + 4, xml.payload.end()), CameraXml().substr(0, 512));
}

}  // namespace
}  // namespace foresight
