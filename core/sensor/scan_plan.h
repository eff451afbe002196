#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/angles.h"
#include "core/sensor/sensor_rig.h"

namespace foresight {

/// What the operator asks of the head: scope, speed and where to take images.
struct ScanPlan {
  enum class ImageMode {
    kOnTheFly,     ///< in passing; the exposure is capped so that the blur stays below max_blur_px
    kStopAndShoot  ///< after the sweep the head goes to each angle, stands still, and shoots
  };

  double from_rad = RadiansFromDegrees(-30.0);
  double to_rad = RadiansFromDegrees(30.0);  ///< below from_rad sweeps downwards
  double speed_rad_s = RadiansFromDegrees(10.0);
  std::vector<double> image_angles_rad = {0.0};  ///< within the scope
  double exposure_s = 0.004;
  double gain_db = 0.0;
  ImageMode image_mode = ImageMode::kOnTheFly;
  double max_blur_px = 0.5;  ///< of an image taken on the fly, at the image centre
  int passes = 1;            ///< 2: there and back in one scan, lines of both

  static constexpr double kMaxSpeed_rad_s = RadiansFromDegrees(120.0);
  static constexpr double kMinAngle_rad = RadiansFromDegrees(-90.0);
  static constexpr double kMaxAngle_rad = RadiansFromDegrees(90.0);

  Status Check() const;

  bool operator==(const ScanPlan&) const = default;
};

/// "on_the_fly", "stop_and_shoot".
const char* ToString(ScanPlan::ImageMode mode);
/// The reverse; fails with kBadData.
Result<ScanPlan::ImageMode> ImageModeFromString(const std::string& text);

/// How a head moves between the parts of a scan; the defaults are the usual head's.
struct HeadMotion {
  double acceleration_rad_s2 = RadiansFromDegrees(400.0);
  double settle_s =
      0.06;  ///< constant speed before and after the scope, standstill before an image
  double travel_speed_rad_s = RadiansFromDegrees(30.0);
};

/// What a plan will cost and give, before it is executed.
struct ScanPrediction {
  double duration_s = 0.0;  ///< from the first line to the last line or image
  int lines = 0;
  double line_spacing_px = 0.0;   ///< at the image centre, mean of all passes
  double beam_spacing_px = 0.0;   ///< at the image centre
  double density = 0.0;           ///< lidar points per image pixel; the paper's floor is 0.02
  double sigma_spatial_px = 0.0;  ///< sigma_s that the depth filter would use, Fig. 6(a)
  double exposure_s = 0.0;        ///< that the head will use, the plan's or the cap
  double blur_px = 0.0;           ///< motion blur of an image, at the image centre
  std::int64_t bytes = 0;         ///< raw ranges, intensities and images
  /// With which the plan still has kMinDensity, at most ScanPlan::kMaxSpeed_rad_s.
  double fastest_speed_rad_s = 0.0;

  static constexpr double kMinDensity = 0.02;  ///< Section IV-C.3
};

/// Fails with kInvalidOptions where the plan or the rig is unusable.
Result<ScanPrediction> PredictScan(const ScanPlan& plan, const SensorRig& rig,
                                   const HeadMotion& motion = {});

/// The exposure with which the head takes the plan's images: on the fly at most
/// max_blur_px / (speed * fy). The plan passes its Check().
double ExposureOnHead(const ScanPlan& plan, const SensorRig& rig);

/// sigma_s for a fraction of measured pixels. Fig. 6(a) of the paper gives 20 px at 2 % and 15 px
/// at 5 %; between and beyond, the power law through these two points, at least 4 px.
double SpatialSigmaForDensity(double density);

}  // namespace foresight
