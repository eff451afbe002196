#include "hardware/head/encoder_watch.h"

#include <gmock/gmock.h>

#include "core/base/random.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

using testing::HasSubstr;

constexpr double kPeriod_s = 1.0 / 240.0;

MotorSample At(double time_s, double deg) {
  return {time_s, RadiansFromDegrees(deg)};
}

/// A watch that has seen a motor at rest at `deg`.
EncoderWatch AtRest(double deg) {
  EncoderWatch watch;
  watch.ExpectAnyMotion(RadiansFromDegrees(30.0));
  EXPECT_FALSE(watch.Check(At(0.0, deg)));
  return watch;
}

TEST(EncoderWatch, BelievesAMotorAtItsSpeedWithNoiseOfItsEncoderAndItsTimes) {
  for (const double speed_deg_s : {1.0, 10.0, 120.0}) {
    EncoderWatch watch = AtRest(-30.0);
    watch.ExpectMotion(1.0, RadiansFromDegrees(speed_deg_s));
    Random random(5);
    for (int i = 1; i < 2400; ++i) {
      // Steps of 0.02 deg, and times that are wrong by some milliseconds.
      const double time_s = i * kPeriod_s;
      const double seen_s = time_s + random.Uniform(-0.002, 0.002);
      const double deg = -30.0 + speed_deg_s * time_s + random.Uniform(-0.02, 0.02);
      ASSERT_EQ(watch.Check(At(seen_s, deg)), std::nullopt) << speed_deg_s << " deg/s, " << i;
    }
  }
}

TEST(EncoderWatch, NamesAJumpWithItsValues) {
  EncoderWatch watch = AtRest(3.0);
  watch.ExpectMotion(1.0, RadiansFromDegrees(10.0));
  EXPECT_FALSE(watch.Check(At(0.004, 3.04)));
  const auto impossible = watch.Check(At(0.008, 83.08));
  ASSERT_TRUE(impossible);
  EXPECT_THAT(*impossible, HasSubstr("its encoder jumped from 3.04 to 83.08 deg within 4.0 ms"));
  EXPECT_THAT(*impossible, HasSubstr("at the commanded 10.0 deg/s"));
}

TEST(EncoderWatch, DoesNotGetUsedToAnOffset) {
  EncoderWatch watch = AtRest(0.0);
  for (int i = 1; i < 50; ++i) EXPECT_TRUE(watch.Check(At(i * kPeriod_s, 80.0))) << i;
  EXPECT_FALSE(watch.Check(At(50 * kPeriod_s, 0.0))) << "it is back where it was";
}

TEST(EncoderWatch, NamesAMotorThatRunsBack) {
  EncoderWatch watch = AtRest(0.0);
  watch.ExpectMotion(-1.0, RadiansFromDegrees(10.0));
  for (int i = 1; i <= 120; ++i)
    ASSERT_FALSE(watch.Check(At(i * kPeriod_s, -10.0 * i * kPeriod_s))) << i;
  std::optional<std::string> impossible;
  for (int i = 121; i <= 140 && !impossible; ++i)
    impossible = watch.Check(At(i * kPeriod_s, -5.0 + 10.0 * (i - 120) * kPeriod_s));
  ASSERT_TRUE(impossible);
  EXPECT_THAT(*impossible, HasSubstr("ran back from -5.00 to -4.4"));
  EXPECT_THAT(*impossible, HasSubstr("commanded downwards"));
}

TEST(EncoderWatch, NamesAnEncoderThatCountsTwiceTheWay) {
  EncoderWatch watch = AtRest(0.0);
  watch.ExpectMotion(1.0, RadiansFromDegrees(10.0));
  std::optional<std::string> impossible;
  int i = 0;
  while (!impossible && ++i < 240)
    impossible = watch.Check(At(i * kPeriod_s, 20.0 * i * kPeriod_s));
  ASSERT_TRUE(impossible);
  EXPECT_THAT(*impossible, HasSubstr("faster than the commanded 10.0 deg/s"));
}

TEST(EncoderWatch, BelievesTheFirstSampleOfANewZero) {
  EncoderWatch watch = AtRest(40.0);
  watch.Forget();
  EXPECT_FALSE(watch.Check(At(0.01, 0.0)));
}

}  // namespace
}  // namespace foresight
