#include "core/simulation/motor_simulator.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/contract.h"
#include "core/geometry/angles.h"
#include "core/simulation/noise_stream.h"

namespace foresight {

MotorSimulator::MotorSimulator(const MotorNoise& noise, std::uint64_t seed) : noise_(noise) {
  Random random = NoiseStream(seed, NoisePurpose::kMotorPhases);
  phase1_rad_ = random.Uniform(0.0, 2.0 * std::numbers::pi);
  phase2_rad_ = random.Uniform(0.0, 2.0 * std::numbers::pi);
  phase50_rad_ = random.Uniform(0.0, 2.0 * std::numbers::pi);
}

double MotorSimulator::PlateAngle(double motor_rad, bool moving_up) const {
  if (!noise_.enabled) return motor_rad;
  // Inside its play the plate trails the shaft.
  const double lag = moving_up ? -0.5 * noise_.backlash_rad : 0.5 * noise_.backlash_rad;
  return motor_rad + lag + noise_.amplitude1_rad * std::sin(motor_rad + phase1_rad_) +
         noise_.amplitude2_rad * std::sin(2.0 * motor_rad + phase2_rad_) +
         noise_.amplitude50_rad * std::sin(50.0 * motor_rad + phase50_rad_);
}

double MotorSimulator::EncoderAngle(double motor_rad) const {
  return (std::floor(motor_rad / noise_.encoder_step_rad) + 0.5) * noise_.encoder_step_rad;
}

AngleCorrection MotorSimulator::CalibratedCorrection() const {
  std::vector<AngleCorrection::Knot> knots;
  for (int degrees = -90; degrees <= 90; degrees += 10) {
    const double motor_rad = RadiansFromDegrees(degrees);
    knots.push_back({motor_rad, PlateAngle(motor_rad, true)});
  }
  auto correction = AngleCorrection::FromKnots(std::move(knots));
  FORESIGHT_EXPECTS(correction.has_value(), "the knots of a motor increase");
  return *correction;
}

}  // namespace foresight
