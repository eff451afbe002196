// The emulator against a client that knows nothing but bytes.
#include "hardware/emulator/scip_emulator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "hardware/scip/scip_codec.h"
#include "tests/hardware/scip_bench.h"

namespace foresight {
namespace {

using testing::EndsWith;
using testing::StartsWith;

class ScipEmulatorTest : public testing::Test {
 protected:
  void Power(const LidarFaults& faults = {}) {
    ScipEmulatorOptions options;
    options.faults = faults;
    emulator_ = ScipEmulator::Start(world_, clock_, shaft_, options).value();
    client_ = TcpSocket::Connect(emulator_->address(), kDeadline).value();
  }

  void Say(const std::string& line) { ASSERT_TRUE(client_.Send(line + "\n", kDeadline)); }

  /// Everything up to the next empty line.
  std::string ReceiveText() {
    std::array<char, 1> byte;
    std::string heard;
    while (!heard.ends_with("\n\n")) {
      const auto size = client_.Receive(byte, kDeadline);
      if (!size || *size == 0) return heard + "(nothing more)";
      heard += byte[0];
    }
    return heard;
  }

  std::string Ask(const std::string& line) {
    Say(line);
    return ReceiveText();
  }

  ScipScan Scan(const std::string& bytes) {
    ScipParser parser;
    parser.Push(bytes);
    return DecodeScipScan(parser.Take().value()).value();
  }

  std::shared_ptr<const World> world_ = TinyWorld();
  std::shared_ptr<SimulatedClock> clock_ =
      std::make_shared<SimulatedClock>(SimulationSpeed::kRealTime);
  std::shared_ptr<SimulatedShaft> shaft_ = std::make_shared<SimulatedShaft>(0.0);
  std::unique_ptr<ScipEmulator> emulator_;
  TcpSocket client_;
};

TEST_F(ScipEmulatorTest, IntroducesItselfByteByByte) {
  Power();
  EXPECT_THAT(Ask("VV;t1"), StartsWith("VV;t1\n00P\nVEND:Hokuyo Automatic Co., Ltd.;;\n"));
  EXPECT_THAT(Ask("PP"), testing::HasSubstr("\nAMAX:60;"));
  EXPECT_THAT(Ask("II"), testing::HasSubstr("\nLASR:OFF;"));
}

TEST_F(ScipEmulatorTest, RefusesWhatTheDeviceRefuses) {
  Power();
  EXPECT_EQ(Ask("XX"), "XX\n0Ee\n\n");
  EXPECT_EQ(Ask("TM1"), "TM1\n03S\n\n");
  EXPECT_EQ(Ask("GD0000006000"), "GD0000006000\n10Q\n\n") << "the laser is off";
  EXPECT_EQ(Ask("ME0000006101000"), "ME0000006101000\n04T\n\n");
}

TEST_F(ScipEmulatorTest, TimeModeBeginsAndEnds) {
  Power();
  EXPECT_EQ(Ask("TM0"), "TM0\n00P\n\n");
  EXPECT_EQ(Ask("TM0"), "TM0\n02R\n\n");
  EXPECT_THAT(Ask("TM1"), StartsWith("TM1\n00P\n"));
  EXPECT_EQ(Ask("MD0000006001000"), "MD0000006001000\n10Q\n\n");
  EXPECT_EQ(Ask("TM2"), "TM2\n00P\n\n");
  EXPECT_EQ(Ask("TM0"), "TM0\n00P\n\n");
  EXPECT_EQ(Ask("QT"), "QT\n00P\n\n") << "leaves time mode too";
  EXPECT_EQ(Ask("TM2"), "TM2\n03S\n\n");
}

TEST_F(ScipEmulatorTest, CountsDownTheScansThatWereAskedFor) {
  Power();
  EXPECT_EQ(Ask("MD0000006001003;a"), "MD0000006001003;a\n00P\n\n");
  for (const char* echo :
       {"MD0000006001002;a\n99b\n", "MD0000006001001;a\n99b\n", "MD0000006001000;a\n99b\n"})
    EXPECT_THAT(ReceiveText(), StartsWith(echo));
  EXPECT_EQ(Ask("TM0"), "TM0\n00P\n\n") << "nothing else was sent, and it is idle";
}

TEST_F(ScipEmulatorTest, SkippedScansAreTurnsOfTheMirror) {
  Power();
  Ask("MD0000006001203");
  const std::uint32_t first = Scan(ReceiveText()).stamp_ms;
  const std::uint32_t second = Scan(ReceiveText()).stamp_ms;
  EXPECT_NEAR(static_cast<double>(second - first), 3 * 25.0, 1.0);
}

TEST_F(ScipEmulatorTest, GroupsReportTheNearestOfTheirSteps) {
  Power();
  EXPECT_EQ(Ask("BM"), "BM\n00P\n\n");
  EXPECT_EQ(Ask("BM"), "BM\n02R\n\n");
  const ScipScan scan = Scan(Ask("GE0010001903"));
  EXPECT_EQ(scan.steps.size(), 4u);
}

TEST_F(ScipEmulatorTest, RebootsOnlyWhenAskedTwice) {
  LidarFaults faults;
  faults.abnormal = true;
  Power(faults);
  EXPECT_EQ(Ask("MD0000006001000"), "MD0000006001000\n0Ll\n\n");
  EXPECT_EQ(Ask("RB"), "RB\n01Q\n\n");
  Say("RB");
  ASSERT_TRUE(Eventually([&] { return emulator_->counts().reboots == 1; }));
  ASSERT_TRUE(Eventually([&] {
    auto client = TcpSocket::Connect(emulator_->address(), kDeadline);
    if (client) client_ = std::move(*client);
    return client.has_value();
  }));
  EXPECT_EQ(Ask("MD0000006001000"), "MD0000006001000\n00P\n\n");
}

TEST_F(ScipEmulatorTest, ListensOnTheAddressItIsGiven) {
  ScipEmulatorOptions options;
  options.address = {"127.0.0.2", 0};
  const auto emulator = ScipEmulator::Start(world_, clock_, shaft_, options).value();
  EXPECT_EQ(emulator->address().host, "127.0.0.2");
  EXPECT_NE(emulator->address().port, 0);
  options.address = emulator->address();
  const auto taken = ScipEmulator::Start(world_, clock_, shaft_, options);
  ASSERT_FALSE(taken);
  EXPECT_THAT(taken.error().message, EndsWith("cannot listen: Address already in use"));
}

TEST_F(ScipEmulatorTest, BadFaultsAreRefused) {
  ScipEmulatorOptions options;
  options.faults.corrupt_fraction = 1.5;
  EXPECT_EQ(ScipEmulator::Start(world_, clock_, shaft_, options).error().message,
            "corrupt_ratio must be from 0 to 1, is 1.5");
}

TEST_F(ScipEmulatorTest, TheSameSeedDamagesTheSameTurns) {
  const auto intact_turns = [] {
    LidarFaults faults;
    faults.seed = 5;
    faults.corrupt_fraction = 0.5;
    ScipBench bench(faults);
    EXPECT_TRUE(bench.Begin());
    std::vector<std::int64_t> turns;
    while (turns.size() < 15) turns.push_back(bench.TurnOf(bench.NextLine()));
    EXPECT_GT(bench.emulator->counts().corrupted, 0);
    return turns;
  };
  const auto first = intact_turns();
  const auto second = intact_turns();
  // The two began at different turns.
  const std::int64_t from = std::max(first.front(), second.front());
  const std::int64_t to = std::min(first.back(), second.back());
  const auto common = [&](std::vector<std::int64_t> turns) {
    std::erase_if(turns, [&](std::int64_t turn) { return turn < from || turn > to; });
    return turns;
  };
  EXPECT_EQ(common(first), common(second));
}

}  // namespace
}  // namespace foresight
