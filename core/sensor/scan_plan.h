#pragma once

#include <cstdint>
#include <vector>

#include "core/base/result.h"
#include "core/sensor/sensor_rig.h"

namespace foresight {

/// What the operator asks of the head: scope, speed and where to take pictures.
struct ScanPlan {
  double from_rad = -0.5235987755982988;         ///< -30 deg
  double to_rad = 0.5235987755982988;            ///< +30 deg; below from_rad sweeps downwards
  double speed_rad_s = 0.17453292519943295;      ///< 10 deg/s
  std::vector<double> image_angles_rad = {0.0};  ///< within the scope
  double exposure_s = 0.004;
  double gain_db = 0.0;

  static constexpr double kMaxSpeed_rad_s = 2.0943951023931953;  ///< 120 deg/s
  static constexpr double kMinAngle_rad = -1.5707963267948966;   ///< -90 deg
  static constexpr double kMaxAngle_rad = 1.5707963267948966;    ///< +90 deg

  Status Check() const;

  bool operator==(const ScanPlan&) const = default;
};

/// What a plan will cost and give, before it is flown.
struct ScanPrediction {
  double duration_s = 0.0;  ///< the sweep itself, without the way to its start
  int lines = 0;
  double line_spacing_px = 0.0;   ///< at the image centre
  double beam_spacing_px = 0.0;   ///< at the image centre
  double density = 0.0;           ///< lidar points per image pixel; the paper's floor is 0.02
  double sigma_spatial_px = 0.0;  ///< sigma_s that the depth filter would use, Fig. 6(a)
  double blur_px = 0.0;           ///< motion blur of a picture taken on the fly
  std::int64_t bytes = 0;         ///< raw ranges, intensities and pictures

  static constexpr double kMinDensity = 0.02;  ///< Section IV-C.3
};

/// Fails with kInvalidOptions where the plan or the rig is unusable.
Result<ScanPrediction> PredictScan(const ScanPlan& plan, const SensorRig& rig);

/// sigma_s for a share of measured pixels. Fig. 6(a) of the paper gives 20 px at 2 % and 15 px at 5
/// %; between and beyond, the power law through these two points, at least 4 px.
double SpatialSigmaForDensity(double density);

}  // namespace foresight
