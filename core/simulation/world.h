#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "core/base/image.h"
#include "core/base/run_context.h"
#include "core/sensor/camera_frame.h"
#include "core/sensor/lidar_line.h"
#include "core/sensor/sensor_rig.h"
#include "core/simulation/noise_options.h"
#include "core/simulation/scene.h"

namespace foresight {

/// A scene with a simulated head in it: what lidar, camera and encoder would report for a motor
/// angle. Physics only; time and motion belong to the devices that call this. The same seed gives
/// the same numbers, whatever the order of calls and the number of threads: every call draws from a
/// stream of its own. Safe to use from many threads; copies share the scene.
class World {
 public:
  /// `true_rig` is the head as it is, not as a calibration believes it to be; its angle correction
  /// is not used (the plate follows PlateAngle). Rig and options have passed their Check().
  World(std::shared_ptr<const Scene> scene, const SensorRig& true_rig, const WorldOptions& options);

  /// As it was given: without stands.
  const Scene& scene() const;
  const SensorRig& true_rig() const;
  const WorldOptions& options() const;

  /// Puts a stand to one of the scene's places, from 1, at once; 0 = all stands are away. All
  /// copies see it; what is being measured is measured at one place. A scene with places begins at
  /// the first. Fails with kInvalidInput where there is no such place.
  Status MoveStand(int place) const;
  int StandAt() const;

  /// Where the plate really is when the motor's shaft is at `motor_rad`, moving up or down.
  double PlateAngle(double motor_rad, bool moving_up) const;
  /// What the encoder reports for a shaft angle: the middle of its step.
  double EncoderAngle(double motor_rad) const;
  /// The correction a perfect calibration of this head would hold (upward sweeps), with knots every
  /// 10 deg as the paper's procedure gives; the part between the knots stays unknown to it.
  AngleCorrection CalibratedCorrection() const;

  /// One turn of the lidar. `motor_rad_at` gives the shaft's angle at a time; each beam asks for
  /// its own. About 3 ms.
  LidarLine MeasureLine(std::int64_t seq, double time_s,
                        const std::function<double(double)>& motor_rad_at) const;

  /// One image, exposed around time_s. motor_angle_rad of the frame is the encoder's at
  /// mid-exposure; target_angle_rad is the caller's to fill. The image is empty when the context
  /// was cancelled. About 1 s of CPU for 1288 x 964.
  CameraFrame CaptureImage(std::int64_t seq, double time_s, double exposure_s, double gain_db,
                           const std::function<double(double)>& motor_rad_at,
                           const RunContext& context) const;

  /// The true depth along z in metres, through the pixel centres of an image taken at a shaft
  /// angle on the way up; NaN = nothing there. Empty when the context was cancelled.
  DepthImage TrueDepth(double motor_rad, const RunContext& context) const;

  /// Which pixels of `true_depth_m`, the TrueDepth at `motor_rad`, show what the lidar can see
  /// while the shaft goes up from `from_rad` to `to_rad`: within its fan and its range, hidden by
  /// nothing. 255 = can be seen. Empty when the context was cancelled.
  MaskImage SeenByLidar(const DepthImage& true_depth_m, double motor_rad, double from_rad,
                        double to_rad, const RunContext& context) const;

  /// The true pose of the scene's frame seen from base, to compare fits with.
  Rigid<frame::Base, frame::Robot> BaseFromRobot() const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace foresight
