#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "core/base/random.h"
#include "core/base/run_context.h"
#include "core/sensor/camera_frame.h"
#include "core/sensor/lidar_line.h"
#include "core/sensor/sensor_rig.h"
#include "core/simulation/ray_caster.h"

namespace foresight {

/// Range errors of the simulated lidar; sources in docs/simulation.md.
struct LidarNoise {
  double sigma_base_m = 0.004;
  double sigma_per_metre = 0.0008;
  double footprint_horizontal_rad = 0.005;
  double footprint_vertical_rad = 0.012;
  int footprint_side = 3;          ///< sub-rays per side of the footprint
  double pulse_length_m = 0.5;     ///< surfaces closer together than this merge into one return
  double dropout_power = 0.004;    ///< returns below this power (albedo cos / r^2) are lost
  double spurious_share = 0.0005;  ///< returns at a random range
  bool enabled = true;             ///< false: exact ranges along the beam's centre
};

struct CameraNoise {
  double full_well_e = 7000.0;
  double read_noise_e = 8.0;
  double pixel_gain_spread = 0.01;      ///< PRNU
  double vignetting = 0.3;              ///< loss of light at the image's corner
  double exposure_for_white_s = 0.006;  ///< a white surface under light 1 just saturates
  int blur_samples = 3;                 ///< sub-exposures while the plate turns
  bool enabled = true;
};

struct MotorNoise {
  double encoder_step_rad = 0.0003490658503988659;  ///< 0.02 deg
  double amplitude1_rad = 0.0013962634015954637;    ///< once a turn, 0.08 deg
  double amplitude2_rad = 0.0005235987755982988;    ///< twice a turn, 0.03 deg
  double amplitude50_rad = 0.0003490658503988659;   ///< fifty times a turn (motor poles), 0.02 deg
  double backlash_rad = 0.0005235987755982988;      ///< between up and down, 0.03 deg
  double jitter_rad = 3.4906585039886593e-05;       ///< 0.002 deg
  bool enabled = true;
};

struct WorldOptions {
  std::uint64_t seed = 1;
  LidarNoise lidar;
  CameraNoise camera;
  MotorNoise motor;
};

/// A scene with a simulated head in it: what lidar, camera and encoder would report for a motor
/// angle. Physics only; time and motion belong to the devices that call this. The same seed gives
/// the same numbers, whatever the order of calls: every call draws from a stream of its own.
class World {
 public:
  /// `true_rig` is the head as it is, not as a calibration believes it to be.
  World(std::shared_ptr<const Scene> scene, const SensorRig& true_rig, const WorldOptions& options);

  const Scene& scene() const;
  const SensorRig& true_rig() const;
  const WorldOptions& options() const;

  /// Where the plate really is when the motor's shaft is at `motor_rad`, moving up or down.
  double PlateAngle(double motor_rad, bool moving_up) const;
  /// What the encoder reports for a shaft angle: the middle of its step.
  double EncoderAngle(double motor_rad) const;
  /// The correction a perfect calibration of this head would hold (upward sweeps), with knots every
  /// 10 deg as the paper's procedure gives; the part between the knots stays unknown to it.
  AngleCorrection CalibratedCorrection() const;

  /// One turn of the lidar. `motor_rad_at` gives the shaft's angle at a time.
  LidarLine MeasureLine(std::int64_t seq, double time_s,
                        const std::function<double(double)>& motor_rad_at) const;

  /// One picture. motor_angle_rad of the frame is the encoder's at mid-exposure.
  CameraFrame TakePicture(std::int64_t seq, double time_s, double exposure_s, double gain_db,
                          const std::function<double(double)>& motor_rad_at,
                          const RunContext& context) const;

  /// The true depth along z in metres of the picture taken at a shaft angle; NaN = nothing there.
  DepthImage TrueDepth(double motor_rad, const RunContext& context) const;

  /// The true pose of the scene's frame seen from base, to compare fits with.
  Rigid<frame::Base, frame::Robot> BaseFromRobot() const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace foresight
