#include "hardware/scip/scip_clock.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/base/random.h"

namespace foresight {
namespace {

constexpr double kPeriod_s = 0.02505;  // as measured on devices

/// A device whose clock and whose connection are known.
struct Device {
  double ppm = 0.0;
  double start_s = 5.0;  ///< its clock at the head's 0
  Random random{3};

  std::uint32_t StampAt(double time_s) const {
    const double device_s = start_s + time_s * (1.0 + 1e-6 * ppm);
    return static_cast<std::uint32_t>(static_cast<std::int64_t>(std::floor(1e3 * device_s))) &
           0xFFFFFF;
  }

  std::vector<ClockReading> Readings(double time_s) {
    std::vector<ClockReading> readings;
    for (int i = 0; i < 40; ++i) {
      const double out_s = 2e-4 + 3e-4 * random.Uniform();
      const double back_s = 2e-4 + 3e-4 * random.Uniform();
      readings.push_back({time_s, time_s + out_s + back_s, StampAt(time_s + out_s)});
      time_s += 2e-3 + 1e-3 * random.Uniform();
    }
    return readings;
  }

  /// Most lines arrive promptly, some late.
  double Arrival(double line_s) {
    const double jitter_s = 2e-4 * random.Uniform();
    const double late_s = random.Uniform() < 0.1 ? 0.02 * random.Uniform() : 0.0;
    return line_s + 0.75 * kPeriod_s + 3e-4 + jitter_s + late_s;
  }
};

struct Errors {
  double rms_s = 0.0;
  double largest_s = 0.0;
  double unevenness_s = 0.0;  ///< rms of the change from line to line
};

/// Errors of the stamps of `lines` lines, once they have settled: from the 40th on.
Errors Follow(ScipClock& clock, Device& device, double begin_s, int lines, double period_s) {
  Errors errors;
  double last_error_s = 0.0;
  for (int i = 0; i < lines; ++i) {
    const double line_s = begin_s + i * period_s;
    const auto placed = clock.Place(device.StampAt(line_s), device.Arrival(line_s));
    const double error_s = placed.time_s - line_s;
    if (i >= 40) {
      errors.rms_s += error_s * error_s / (lines - 40);
      errors.unevenness_s += std::pow(error_s - last_error_s, 2) / (lines - 40);
      errors.largest_s = std::max(errors.largest_s, std::abs(error_s));
    }
    last_error_s = error_s;
  }
  errors.rms_s = std::sqrt(errors.rms_s);
  errors.unevenness_s = std::sqrt(errors.unevenness_s);
  return errors;
}

TEST(StampUnwrapper, CountsOnOverTheWrap) {
  StampUnwrapper unwrapper;
  EXPECT_EQ(unwrapper.Unwrap(0xFFFFF0), 0xFFFFF0) << "the first value counts too";
  EXPECT_EQ(unwrapper.Unwrap(0x000009), 0x1000009);
  EXPECT_EQ(unwrapper.Unwrap(0xFFFFFF), 0xFFFFFF) << "and back";
  EXPECT_EQ(unwrapper.Unwrap(0x000001), 0x1000001);
}

TEST(StampUnwrapper, WrapsAgainAndAgain) {
  StampUnwrapper unwrapper;
  std::int64_t truth = 0;
  for (int i = 0; i < 100; ++i, truth += 5'000'000)
    ASSERT_EQ(unwrapper.Unwrap(static_cast<std::uint32_t>(truth & 0xFFFFFF)), truth);
}

TEST(ScipClock, StampsOfWholeMillisecondsAreAveragedToATenthOfOne) {
  Device device;
  ScipClock clock(0.025);  // what the device says of itself
  clock.Synchronise(device.Readings(0.0));
  const Errors errors = Follow(clock, device, 0.2, 400, kPeriod_s);
  // The way there and back differs by 0.3 ms at most; half of that may remain.
  EXPECT_LT(errors.rms_s, 0.15e-3);
  EXPECT_LT(errors.largest_s, 0.3e-3);
  RecordProperty("rms_us", static_cast<int>(1e6 * errors.rms_s));
  RecordProperty("unevenness_us", static_cast<int>(1e6 * errors.unevenness_s));
  EXPECT_LT(errors.unevenness_s, 0.03e-3);
  EXPECT_NEAR(clock.period_s(), kPeriod_s, 5e-6);
}

TEST(ScipClock, TheVeryFirstLinesAreWithinAMillisecond) {
  Device device;
  ScipClock clock(0.025);
  clock.Synchronise(device.Readings(0.0));
  for (int i = 0; i < 40; ++i) {
    const double line_s = 0.2 + i * kPeriod_s;
    EXPECT_NEAR(clock.Place(device.StampAt(line_s), device.Arrival(line_s)).time_s, line_s, 1e-3);
  }
}

TEST(ScipClock, FollowsADriftingClockByTheEarliestArrivals) {
  for (const double ppm : {100.0, -100.0, 300.0}) {
    Device device;
    device.ppm = ppm;
    ScipClock clock(0.025);
    clock.Synchronise(device.Readings(0.0));
    // After two minutes of 100 ppm the clock is off by 12 ms.
    const Errors errors = Follow(clock, device, 0.2, 4800, kPeriod_s);
    EXPECT_LT(errors.largest_s, 1e-3) << ppm;
    EXPECT_NEAR(clock.drift_ppm(), -ppm, 10.0);
  }
}

TEST(ScipClock, LateArrivalsDoNotPassForDrift) {
  Device device;
  ScipClock clock(0.025);
  clock.Synchronise(device.Readings(0.0));
  Follow(clock, device, 0.2, 200, kPeriod_s);
  for (int i = 200; i < 280; ++i) {  // two seconds of a blocked network
    const double line_s = 0.2 + i * kPeriod_s;
    const auto placed = clock.Place(device.StampAt(line_s), device.Arrival(line_s) + 0.02);
    EXPECT_NEAR(placed.time_s, line_s, 1e-3);
  }
}

TEST(ScipClock, CountsTheTurnsThatWereMissed) {
  Device device;
  ScipClock clock(0.025);
  clock.Synchronise(device.Readings(0.0));
  Follow(clock, device, 0.2, 100, kPeriod_s);
  const double line_s = 0.2 + 139 * kPeriod_s;
  EXPECT_EQ(clock.Place(device.StampAt(line_s), device.Arrival(line_s)).turns, 40);
}

TEST(ScipClock, AClockThatWasSetBackIsNoDriftAndLosesNoTurns) {
  Device device;
  ScipClock clock(kPeriod_s);
  clock.Synchronise(device.Readings(0.0));
  Follow(clock, device, 0.2, 100, kPeriod_s);
  device.start_s = -3.0;  // rebooted
  clock.Synchronise(device.Readings(10.0));
  EXPECT_LT(std::abs(clock.drift_ppm()), 100.0);
  const double line_s = 0.2 + 500 * kPeriod_s;
  const auto placed = clock.Place(device.StampAt(line_s), device.Arrival(line_s));
  EXPECT_EQ(placed.turns, 401);
  EXPECT_NEAR(placed.time_s, line_s, 1e-3);
}

TEST(ScipClock, TwoReadingsMeasureTheDriftBetweenScans) {
  Device device;
  device.ppm = 50.0;
  ScipClock clock(kPeriod_s);
  clock.Synchronise(device.Readings(0.0));
  clock.Synchronise(device.Readings(60.0));
  EXPECT_NEAR(clock.drift_ppm(), -50.0, 5.0);
}

}  // namespace
}  // namespace foresight
