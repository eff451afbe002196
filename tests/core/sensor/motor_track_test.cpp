#include "core/sensor/motor_track.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/geometry/angles.h"

namespace foresight {
namespace {

constexpr double kStep_rad = 0.0003490658503988659;  // 0.02 deg, the encoder's step

MotorTrack SweepAt(double speed_deg_s, double rate_hz, double duration_s) {
  MotorTrack track;
  for (int i = 0; i <= duration_s * rate_hz; ++i) {
    const double t = i / rate_hz;
    const double angle = RadiansFromDegrees(speed_deg_s) * t;
    track.Add({t, (std::floor(angle / kStep_rad) + 0.5) * kStep_rad});
  }
  return track;
}

TEST(MotorTrack, AveragesTheEncodersStepsAway) {
  const MotorTrack track = SweepAt(10.0, 240.0, 2.0);
  double squares = 0.0;
  int count = 0;
  for (double t = 0.1; t < 1.9; t += 0.0013, ++count) {
    const double error = track.AngleAt(t) - RadiansFromDegrees(10.0) * t;
    squares += error * error;
  }
  // The bar is 0.01 deg rms; single samples have 0.0058 deg from their steps alone.
  EXPECT_LT(DegreesFromRadians(std::sqrt(squares / count)), 0.004);
}

TEST(MotorTrack, KnowsNothingOutsideItsTime) {
  const MotorTrack track = SweepAt(10.0, 240.0, 1.0);
  EXPECT_TRUE(std::isnan(track.AngleAt(-0.001)));
  EXPECT_TRUE(std::isnan(track.AngleAt(1.001)));
  EXPECT_FALSE(std::isnan(track.AngleAt(0.0)));
}

TEST(MotorTrack, KnowsNothingInAGap) {
  MotorTrack track;
  for (const double t : {0.0, 0.01, 0.02, 0.5, 0.51, 0.52}) track.Add({t, t});
  EXPECT_TRUE(std::isnan(track.AngleAt(0.25)));
}

TEST(MotorTrack, RefusesTimeThatDoesNotIncrease) {
  EXPECT_EQ(MotorTrack::FromSamples({{0.0, 0.0}, {0.0, 0.1}}).error().code, ErrorCode::kBadData);
  EXPECT_EQ(MotorTrack::FromSamples({{0.0, NAN}}).error().code, ErrorCode::kBadData);
}

TEST(AngleCorrection, WithoutKnotsChangesNothing) {
  EXPECT_EQ(AngleCorrection().PlateAngle(0.3), 0.3);
}

TEST(AngleCorrection, PassesThroughItsKnots) {
  const auto correction =
      AngleCorrection::FromKnots({{-0.5, -0.51}, {0.0, 0.0}, {0.4, 0.405}, {0.9, 0.89}});
  ASSERT_TRUE(correction);
  for (const auto& knot : correction->knots())
    EXPECT_NEAR(correction->PlateAngle(knot.motor_rad), knot.plate_rad, 1e-15);
}

TEST(AngleCorrection, FollowsASmoothErrorBetweenKnotsTenDegreesApart) {
  const auto truth = [](double a) { return a + RadiansFromDegrees(0.08) * std::sin(a + 0.4); };
  std::vector<AngleCorrection::Knot> knots;
  for (int d = -30; d <= 80; d += 10)
    knots.push_back({RadiansFromDegrees(d), truth(RadiansFromDegrees(d))});
  const auto correction = AngleCorrection::FromKnots(knots);
  ASSERT_TRUE(correction);
  // A natural spline bends at its ends: h^2 / 8 times the second derivative there, 0.0003 deg.
  for (double a = -0.52; a < 1.39; a += 0.01)
    EXPECT_LT(DegreesFromRadians(std::abs(correction->PlateAngle(a) - truth(a))), 0.0004);
}

TEST(AngleCorrection, RefusesKnotsOutOfOrder) {
  EXPECT_FALSE(AngleCorrection::FromKnots({{0.1, 0.1}, {0.1, 0.2}}));
}

}  // namespace
}  // namespace foresight
