#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/geometry/angles.h"
#include "core/simulation/motor_simulator.h"

namespace foresight {
namespace {

/// Largest difference between the corrected and the true plate angle within the knots, upwards.
double LargestResidual(const MotorSimulator& motor) {
  const AngleCorrection correction = motor.CalibratedCorrection();
  double largest = 0.0;
  for (int tenths = -900; tenths <= 900; ++tenths) {
    const double motor_rad = RadiansFromDegrees(0.1 * tenths);
    largest = std::max(
        largest, std::abs(correction.PlateAngle(motor_rad) - motor.PlateAngle(motor_rad, true)));
  }
  return largest;
}

TEST(Motor, PlateDepartsFromTheShaftAsMuchAsItsTermsAllow) {
  const MotorSimulator motor({}, 1);
  double largest = 0.0;
  for (int degrees = -90; degrees <= 90; ++degrees) {
    const double motor_rad = RadiansFromDegrees(degrees);
    largest = std::max(largest, std::abs(motor.PlateAngle(motor_rad, true) - motor_rad));
  }
  EXPECT_GT(largest, RadiansFromDegrees(0.05));
  EXPECT_LT(largest, RadiansFromDegrees(0.08 + 0.03 + 0.02 + 0.015));
}

TEST(Motor, ACalibrationEveryTenDegreesRecoversTheSlowTerms) {
  MotorNoise noise;
  noise.amplitude50_rad = 0.0;
  // A natural spline through 10 deg knots misses sin(2 x) of 0.03 deg by less than 0.0005 deg; at
  // its two ends, where it takes the curvature for zero, by 0.001 deg.
  for (const std::uint64_t seed : {1, 2, 3})
    EXPECT_LT(LargestResidual(MotorSimulator(noise, seed)), RadiansFromDegrees(0.001)) << seed;
}

TEST(Motor, TheFastTermStaysUnknownToACalibrationEveryTenDegrees) {
  // 50 periods a turn cannot be seen by 36 knots a turn: the residual is up to twice its 0.02 deg.
  for (const std::uint64_t seed : {1, 2, 3}) {
    const double residual = LargestResidual(MotorSimulator({}, seed));
    EXPECT_GT(residual, RadiansFromDegrees(0.02)) << seed;
    EXPECT_LT(residual, RadiansFromDegrees(0.045)) << seed;
  }
}

TEST(Motor, ACalibrationKnowsThePlateAtItsKnotsEveryTenDegrees) {
  const MotorSimulator motor({}, 1);
  const AngleCorrection correction = motor.CalibratedCorrection();
  ASSERT_EQ(correction.knots().size(), 19u);
  for (const AngleCorrection::Knot& knot : correction.knots())
    EXPECT_NEAR(correction.PlateAngle(knot.motor_rad), motor.PlateAngle(knot.motor_rad, true),
                1e-12);
}

TEST(Motor, BacklashSeparatesUpFromDown) {
  const MotorSimulator motor({}, 1);
  EXPECT_NEAR(motor.PlateAngle(0.3, false) - motor.PlateAngle(0.3, true), RadiansFromDegrees(0.03),
              1e-12);
}

TEST(Motor, EncoderReportsTheMiddleOfItsStep) {
  const MotorSimulator motor({}, 1);
  const double half_step = 0.5 * MotorNoise{}.encoder_step_rad;
  for (int i = -500; i < 500; ++i) {
    const double motor_rad = 0.00123 * i;
    ASSERT_LE(std::abs(motor.EncoderAngle(motor_rad) - motor_rad), half_step + 1e-12) << i;
  }
  EXPECT_EQ(motor.EncoderAngle(0.1 * half_step), motor.EncoderAngle(1.9 * half_step));
}

TEST(Motor, AnotherSeedIsAnotherMotor) {
  EXPECT_NE(MotorSimulator({}, 1).PlateAngle(0.3, true),
            MotorSimulator({}, 2).PlateAngle(0.3, true));
}

TEST(Motor, WithoutNoiseThePlateIsWhereTheShaftIs) {
  MotorNoise noise;
  noise.enabled = false;
  EXPECT_EQ(MotorSimulator(noise, 1).PlateAngle(0.3, false), 0.3);
}

}  // namespace
}  // namespace foresight
