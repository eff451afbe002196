#include "core/simulation/noise_options.h"

#include <cmath>

namespace foresight {
namespace {

Status NotNegative(const char* name, double value) {
  if (!(value >= 0.0) || !std::isfinite(value))
    return Fail(ErrorCode::kInvalidOptions, "{} {} is negative or not finite", name, value);
  return {};
}

Status Positive(const char* name, double value) {
  if (!(value > 0.0) || !std::isfinite(value))
    return Fail(ErrorCode::kInvalidOptions, "{} {} is not positive", name, value);
  return {};
}

Status CheckFraction(const char* name, double value) {
  if (!(value >= 0.0 && value <= 1.0))
    return Fail(ErrorCode::kInvalidOptions, "{} {} is not between 0 and 1", name, value);
  return {};
}

Status RaysPerSide(const char* name, int value) {
  if (value < 1 || value > 16)
    return Fail(ErrorCode::kInvalidOptions, "{} {} is not between 1 and 16", name, value);
  return {};
}

}  // namespace

Status LidarNoise::Check() const {
  FORESIGHT_CHECK(NotNegative("lidar sigma_base_m", sigma_base_m));
  FORESIGHT_CHECK(NotNegative("lidar sigma_per_metre", sigma_per_metre));
  FORESIGHT_CHECK(NotNegative("lidar sigma_at_threshold_m", sigma_at_threshold_m));
  FORESIGHT_CHECK(NotNegative("lidar walk_at_threshold_m", walk_at_threshold_m));
  FORESIGHT_CHECK(NotNegative("lidar footprint_horizontal_rad", footprint_horizontal_rad));
  FORESIGHT_CHECK(NotNegative("lidar footprint_vertical_rad", footprint_vertical_rad));
  FORESIGHT_CHECK(RaysPerSide("lidar footprint_side", footprint_side));
  FORESIGHT_CHECK(NotNegative("lidar pulse_length_m", pulse_length_m));
  FORESIGHT_CHECK(Positive("lidar dropout_power", dropout_power));
  FORESIGHT_CHECK(CheckFraction("lidar spurious_fraction", spurious_fraction));
  if (tail_degrees < 0 || tail_degrees > 100)
    return Fail(ErrorCode::kInvalidOptions, "lidar tail_degrees {} is not between 0 and 100",
                tail_degrees);
  FORESIGHT_CHECK(NotNegative("lidar walk_of_black_m", walk_of_black_m));
  return CheckFraction("lidar leading_edge", leading_edge);
}

Status CameraNoise::Check() const {
  FORESIGHT_CHECK(Positive("camera full_well_e", full_well_e));
  FORESIGHT_CHECK(NotNegative("camera read_noise_e", read_noise_e));
  FORESIGHT_CHECK(CheckFraction("camera pixel_gain_spread", pixel_gain_spread));
  FORESIGHT_CHECK(CheckFraction("camera vignetting", vignetting));
  FORESIGHT_CHECK(Positive("camera exposure_for_white_s", exposure_for_white_s));
  FORESIGHT_CHECK(Positive("camera gamma", gamma));
  return RaysPerSide("camera samples_side", samples_side);
}

Status MotorNoise::Check() const {
  FORESIGHT_CHECK(Positive("motor encoder_step_rad", encoder_step_rad));
  FORESIGHT_CHECK(NotNegative("motor amplitude1_rad", amplitude1_rad));
  FORESIGHT_CHECK(NotNegative("motor amplitude2_rad", amplitude2_rad));
  FORESIGHT_CHECK(NotNegative("motor amplitude50_rad", amplitude50_rad));
  FORESIGHT_CHECK(NotNegative("motor backlash_rad", backlash_rad));
  return NotNegative("motor jitter_rad", jitter_rad);
}

Status WorldOptions::Check() const {
  FORESIGHT_CHECK(lidar.Check());
  FORESIGHT_CHECK(camera.Check());
  return motor.Check();
}

}  // namespace foresight
