// What was wrong with a lidar's lines is named as what it is.
#include <gmock/gmock.h>

#include "hardware/scip/scip_clock.h"
#include "hardware/scip/scip_line_troubles.h"
#include "hardware/scip/scip_stamp_watch.h"
#include "tests/hardware/scip_bench.h"

namespace foresight {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(ScipLineTroubles, NamesTheMostFrequentOneWithItsNumbers) {
  ScipLineTroubles troubles;
  EXPECT_EQ(troubles.Describe(0.0), "");
  for (int i = 0; i < 40; ++i)
    troubles.Note(0.025 * i, i % 13 == 0 ? ScipLineTrouble::kNone : ScipLineTrouble::kBadSum, "");
  EXPECT_EQ(troubles.Describe(1.0),
            "36 of 40 lines had a bad check sum in the last 1.5 s; check the lidar's cable");
  for (int i = 40; i < 100; ++i)
    troubles.Note(0.025 * i, ScipLineTrouble::kWrongBeams, "1000 beams instead of 1081");
  EXPECT_EQ(troubles.Describe(2.5),
            "60 of 60 lines had 1000 beams instead of 1081 in the last 1.5 s; check the lidar's "
            "model and settings");
  EXPECT_EQ(troubles.Describe(10.0), "") << "what is over is forgotten";
}

/// A device whose clock is 5 s behind the head's; lines of 25 ms that come after 19 ms.
class Stamps {
 public:
  Stamps() { watch_.Reset(0); }
  std::optional<std::string> Line(double shift_s = 0.0, double delay_s = 0.019) {
    const double device_s = 0.025 * ++turn_;
    const auto stamp =
        static_cast<std::uint32_t>(std::lround(1e3 * (device_s + shift_s))) & 0xFFFFFF;
    return watch_.Check(stamp, device_s + 5.0 + delay_s, 5.0);
  }
  void Healthy(int lines) {
    for (int i = 0; i < lines; ++i) ASSERT_EQ(Line(), std::nullopt) << i;
  }

 private:
  ScipStampWatch watch_;
  int turn_ = 0;
};

TEST(ScipStampWatch, BelievesAHealthyDeviceAcrossTheWrapOfItsClock) {
  ScipStampWatch watch;
  const std::int64_t start_ms = 0xFFFFFF - 3000;
  watch.Reset(start_ms);
  for (int i = 1; i < 1000; ++i) {
    const std::int64_t device_ms = start_ms + 25 * i;
    const double arrival_s = 1e-3 * static_cast<double>(device_ms) + 7.0 + 0.02;
    ASSERT_EQ(watch.Check(static_cast<std::uint32_t>(device_ms & 0xFFFFFF), arrival_s, 7.0),
              std::nullopt)
        << i;
  }
}

TEST(ScipStampWatch, NamesAJumpAheadAndABackwardRunAndAClockThatStands) {
  Stamps ahead;
  ahead.Healthy(10);
  EXPECT_THAT(ahead.Line(3600.0).value_or(""), HasSubstr("jumped ahead by 3599.9"));
  ahead.Healthy(10);  // one stamp that was wrong does not spoil the others

  Stamps back;
  back.Healthy(10);
  EXPECT_EQ(back.Line(-0.3).value_or(""), "ran backwards by 0.275 s");

  Stamps stands;
  stands.Healthy(10);
  EXPECT_EQ(stands.Line(-0.025).value_or(""), "stand still at 0.250 s");
}

TEST(ScipStampWatch, ForgivesTheNetworkASecondButNoLonger) {
  Stamps stamps;
  stamps.Healthy(10);
  EXPECT_FALSE(stamps.Line(0.0, 1.0)) << "it waited for a packet that was sent again";
  EXPECT_FALSE(stamps.Line(0.0, 0.975));
  stamps.Healthy(10);
  std::optional<std::string> wrong;
  for (int i = 0; i < 40 && !wrong; ++i) wrong = stamps.Line(0.0, 0.4);
  EXPECT_THAT(wrong.value_or(""), HasSubstr("s behind"));
}

/// A stream that shows a trouble; what the driver says of it.
std::string TroubleOf(ScipBench& bench) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (std::chrono::steady_clock::now() < end) {
    static_cast<void>(bench.lidar->WaitForLine(std::chrono::milliseconds(20)));
    const LidarHealth health = bench.lidar->Health();
    if (!health.trouble.empty()) return health.trouble;
  }
  return "";
}

TEST(ScipLidarQuality, BadSumsAreNamedAsSuch) {
  ScipBench bench;
  ASSERT_TRUE(bench.Begin());
  bench.emulator->InjectCorruptScans(1000);
  EXPECT_THAT(TroubleOf(bench), HasSubstr("had a bad check sum in the last 1.5 s"));
}

TEST(ScipLidarQuality, AWrongNumberOfBeamsIsNamedAsSuch) {
  ScipBench bench;
  ASSERT_TRUE(bench.Begin());
  bench.emulator->InjectMissingBeams(10, 1000);
  EXPECT_THAT(TroubleOf(bench), HasSubstr("had 51 beams instead of 61"));
}

TEST(ScipLidarQuality, AClockThatStandsIsNamedAsSuch) {
  ScipBench bench;
  ASSERT_TRUE(bench.Begin());
  bench.emulator->InjectStoppedClock(60.0);
  EXPECT_THAT(TroubleOf(bench), HasSubstr("time stamps stand still at"));
}

TEST(ScipLidarQuality, AfterAJumpOfTheClockLinesHaveTheirTrueTimesAgain) {
  for (const double jump_s : {3600.0, -0.3}) {
    ScipBench bench;
    ASSERT_TRUE(bench.Begin());
    for (int i = 0; i < 10; ++i) bench.NextLine();
    bench.emulator->InjectClockJump(jump_s);
    EXPECT_THAT(TroubleOf(bench), HasSubstr(jump_s > 0.0 ? "time stamps jumped ahead by"
                                                         : "time stamps ran backwards"));
    int lines = 0;
    double last_s = 0.0;
    while (lines < 40) {
      const LidarLine line = bench.NextLine();
      // A turn later than now and 0.3 s before it lies what the network may do, and no jump.
      const double age_s = bench.clock->Now() - line.time_s;
      EXPECT_GT(age_s, 0.0);
      EXPECT_LT(age_s, 0.25) << "line " << line.seq << " after a jump of " << jump_s << " s";
      EXPECT_GT(line.time_s, last_s);
      last_s = line.time_s;
      ++lines;
    }
    EXPECT_GE(bench.lidar->Health().reconnects, 1);
  }
}

}  // namespace
}  // namespace foresight
