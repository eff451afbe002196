#pragma once

#include <cstdint>

#include "core/base/result.h"
#include "core/geometry/angles.h"

namespace foresight {

/// Errors of the simulated lidar; sources in docs/simulation.md. The power of a return is
/// reflectance * cos(incidence) / range^2.
struct LidarNoise {
  double sigma_base_m = 0.004;
  double sigma_per_metre = 0.0008;
  double sigma_at_threshold_m =
      0.020;  ///< added to a return that is just not lost; falls as 1/power
  double walk_at_threshold_m = 0.005;  ///< such a return also reads longer by this
  double footprint_horizontal_rad = 0.005;
  double footprint_vertical_rad = 0.012;
  int footprint_side = 3;             ///< sub-rays per side of the footprint
  double pulse_length_m = 0.5;        ///< surfaces closer together than this merge into one return
  double dropout_power = 0.001;       ///< weaker returns are lost: a white sheet beyond 30 m
  double spurious_fraction = 0.0005;  ///< returns at a random range
  /// How a beam's light is spread over its footprint: evenly over the rectangle, or as a Gaussian
  /// whose deviations are half of its half sides.
  enum class Footprint { kEven, kGaussian } footprint = Footprint::kEven;
  /// Degrees of freedom of Student's t distribution of the range error, with the deviation above
  /// as its scale; 0 = normal.
  int tail_degrees = 0;
  /// A surface of reflectance 0 reads longer by this, one of reflectance 1 not at all.
  double walk_of_black_m = 0.0;
  /// What merges reads this fraction of the way from its mean range to its nearest surface.
  double leading_edge = 0.0;
  bool enabled = true;  ///< false: exact ranges along the beam's centre, nothing lost

  Status Check() const;
};

struct CameraNoise {
  double full_well_e = 7000.0;
  double read_noise_e = 8.0;
  double pixel_gain_spread = 0.01;      ///< PRNU, fixed by the seed
  double vignetting = 0.3;              ///< loss of light at the image's corner
  double exposure_for_white_s = 0.006;  ///< a white surface under light 1 just saturates
  double gamma = 2.2;                   ///< of the camera's output; 1 = linear
  /// Sub-rays per side of a pixel. They are spread over the exposure too, so a turning plate blurs.
  int samples_side = 2;
  bool enabled = true;  ///< false: no noise, no PRNU, no vignetting; light, gamma and blur stay

  Status Check() const;
};

struct MotorNoise {
  double encoder_step_rad = 0.0003490658503988659;   ///< 0.02 deg
  double amplitude1_rad = RadiansFromDegrees(0.08);  ///< once a turn
  double amplitude2_rad = RadiansFromDegrees(0.03);  ///< twice a turn
  double amplitude50_rad = 0.0003490658503988659;    ///< fifty times a turn (motor poles), 0.02 deg
  double backlash_rad = RadiansFromDegrees(0.03);    ///< between up and down
  double jitter_rad = RadiansFromDegrees(0.002);     ///< from line to line
  bool enabled = true;  ///< false: the plate is where the shaft is; the encoder keeps its step

  Status Check() const;
};

struct WorldOptions {
  std::uint64_t seed = 1;
  LidarNoise lidar;
  CameraNoise camera;
  MotorNoise motor;

  /// Fails with kInvalidOptions, naming the member.
  Status Check() const;
};

}  // namespace foresight
