#pragma once

#include <cstdint>

#include "core/sensor/motor_track.h"
#include "core/simulation/noise_options.h"

namespace foresight {

/// A motor, its encoder and the gear to the plate. The plate's error repeats from turn to turn, as
/// the paper assumes, but depends on the direction.
class MotorSimulator {
 public:
  MotorSimulator(const MotorNoise& noise, std::uint64_t seed);

  double PlateAngle(double motor_rad, bool moving_up) const;
  double EncoderAngle(double motor_rad) const;
  AngleCorrection CalibratedCorrection() const;

 private:
  MotorNoise noise_;
  double phase1_rad_;
  double phase2_rad_;
  double phase50_rad_;
};

}  // namespace foresight
