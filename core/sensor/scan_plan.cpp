#include "core/sensor/scan_plan.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/angles.h"
#include "core/sensor/exposure.h"

namespace foresight {

Status ScanPlan::Check() const {
  const auto in_reach = [](double angle) {
    return angle >= kMinAngle_rad && angle <= kMaxAngle_rad;
  };
  if (!in_reach(from_rad) || !in_reach(to_rad))
    return Fail(ErrorCode::kInvalidOptions,
                "scan plan: scope {:.1f} to {:.1f} deg leaves {:.0f} to {:.0f} deg",
                DegreesFromRadians(from_rad), DegreesFromRadians(to_rad),
                DegreesFromRadians(kMinAngle_rad), DegreesFromRadians(kMaxAngle_rad));
  if (std::abs(to_rad - from_rad) < RadiansFromDegrees(0.1))
    return Fail(ErrorCode::kInvalidOptions, "scan plan: scope {:.2f} to {:.2f} deg is empty",
                DegreesFromRadians(from_rad), DegreesFromRadians(to_rad));
  if (!(speed_rad_s > 0.0 && speed_rad_s <= kMaxSpeed_rad_s + 1e-9))
    return Fail(ErrorCode::kInvalidOptions, "scan plan: speed {:.2f} deg/s is not in (0, {:.0f}]",
                DegreesFromRadians(speed_rad_s), DegreesFromRadians(kMaxSpeed_rad_s));
  if (const Status exposure = CheckExposure(exposure_s, gain_db); !exposure)
    return Fail(ErrorCode::kInvalidOptions, "scan plan: {}", exposure.error().message);
  if (!(max_blur_px > 0.0 && max_blur_px <= 100.0))
    return Fail(ErrorCode::kInvalidOptions, "scan plan: max_blur_px {} is not in (0, 100]",
                max_blur_px);
  if (passes != 1 && passes != 2)
    return Fail(ErrorCode::kInvalidOptions, "scan plan: passes {} is neither 1 nor 2", passes);
  if (image_angles_rad.empty() || image_angles_rad.size() > 1000)
    return Fail(ErrorCode::kInvalidOptions, "scan plan: {} images; between 1 and 1000 are possible",
                image_angles_rad.size());
  const auto [low, high] = std::minmax(from_rad, to_rad);
  for (const double angle : image_angles_rad)
    if (!(angle >= low - 1e-9 && angle <= high + 1e-9))
      return Fail(ErrorCode::kInvalidOptions,
                  "scan plan: image at {:.1f} deg is outside the scope {:.1f} to {:.1f} deg",
                  DegreesFromRadians(angle), DegreesFromRadians(low), DegreesFromRadians(high));
  return {};
}

const char* ToString(ScanPlan::ImageMode mode) {
  return mode == ScanPlan::ImageMode::kStopAndShoot ? "stop_and_shoot" : "on_the_fly";
}

Result<ScanPlan::ImageMode> ImageModeFromString(const std::string& text) {
  for (const auto mode : {ScanPlan::ImageMode::kOnTheFly, ScanPlan::ImageMode::kStopAndShoot})
    if (text == ToString(mode)) return mode;
  return Fail(ErrorCode::kBadData, "image mode '{}' is neither on_the_fly nor stop_and_shoot",
              text);
}

double ExposureOnHead(const ScanPlan& plan, const SensorRig& rig) {
  if (plan.image_mode == ScanPlan::ImageMode::kStopAndShoot) return plan.exposure_s;
  return std::min(plan.exposure_s, plan.max_blur_px / (plan.speed_rad_s * rig.camera.fy));
}

namespace {

/// From standstill to standstill.
double TravelTime(double way_rad, const HeadMotion& motion) {
  const double distance = std::abs(way_rad);
  if (distance == 0.0) return 0.0;
  const double top =
      std::min(motion.travel_speed_rad_s, std::sqrt(distance * motion.acceleration_rad_s2));
  return distance / top + top / motion.acceleration_rad_s2;
}

/// From the end of the scope to standstill, or from there to the scope.
double RunUpTime(double speed_rad_s, const HeadMotion& motion) {
  return speed_rad_s / motion.acceleration_rad_s2 + motion.settle_s;
}

/// From the end of the last pass to the last image, all taken standing still.
double ShootingTime(const ScanPlan& plan, const HeadMotion& motion) {
  const double way_out =
      plan.speed_rad_s * (0.5 * plan.speed_rad_s / motion.acceleration_rad_s2 + motion.settle_s);
  std::vector<double> stops = plan.image_angles_rad;
  std::sort(stops.begin(), stops.end());
  const bool ends_high = (plan.to_rad > plan.from_rad) == (plan.passes % 2 == 1);
  if (ends_high) std::reverse(stops.begin(), stops.end());
  double at = ends_high ? std::max(plan.from_rad, plan.to_rad) + way_out
                        : std::min(plan.from_rad, plan.to_rad) - way_out;
  double time_s = RunUpTime(plan.speed_rad_s, motion);
  for (const double stop : stops) {
    time_s += TravelTime(stop - at, motion) + 2.0 * motion.settle_s + plan.exposure_s;
    at = stop;
  }
  return time_s;
}

double Duration(const ScanPlan& plan, const HeadMotion& motion) {
  const double pass_s = std::abs(plan.to_rad - plan.from_rad) / plan.speed_rad_s;
  const double turns_s = 2.0 * (plan.passes - 1) * RunUpTime(plan.speed_rad_s, motion);
  const bool shoots = plan.image_mode == ScanPlan::ImageMode::kStopAndShoot;
  return plan.passes * pass_s + turns_s + (shoots ? ShootingTime(plan, motion) : 0.0);
}

/// Those that lie in the scope with all of their beams, and one on each side.
int LinesOfAPass(const ScanPlan& plan, const LidarModel& lidar) {
  const double pass_s = std::abs(plan.to_rad - plan.from_rad) / plan.speed_rad_s;
  const double line_s = lidar.BeamTime(lidar.beams - 1) - lidar.BeamTime(0);
  return std::max(0, static_cast<int>(std::lround((pass_s - line_s) / lidar.period_s))) + 2;
}

}  // namespace

Result<ScanPrediction> PredictScan(const ScanPlan& plan, const SensorRig& rig,
                                   const HeadMotion& motion) {
  FORESIGHT_CHECK(plan.Check());
  FORESIGHT_CHECK(rig.Check());
  ScanPrediction prediction;
  prediction.duration_s = Duration(plan, motion);
  prediction.lines = plan.passes * LinesOfAPass(plan, rig.lidar);
  // Near the optical axis the image has f pixels a radian.
  const double spacing_per_speed = rig.lidar.period_s * rig.camera.fy / plan.passes;
  prediction.line_spacing_px = plan.speed_rad_s * spacing_per_speed;
  prediction.beam_spacing_px = rig.lidar.angle_step_rad * rig.camera.fx;
  prediction.density =
      std::min(1.0, 1.0 / (prediction.line_spacing_px * prediction.beam_spacing_px));
  prediction.fastest_speed_rad_s = std::min(
      ScanPlan::kMaxSpeed_rad_s,
      1.0 / (ScanPrediction::kMinDensity * spacing_per_speed * prediction.beam_spacing_px));
  prediction.sigma_spatial_px = SpatialSigmaForDensity(prediction.density);
  prediction.exposure_s = ExposureOnHead(plan, rig);
  if (plan.image_mode == ScanPlan::ImageMode::kOnTheFly)
    prediction.blur_px = plan.speed_rad_s * prediction.exposure_s * rig.camera.fy;
  prediction.bytes = static_cast<std::int64_t>(prediction.lines) * rig.lidar.beams * 4 +
                     static_cast<std::int64_t>(plan.image_angles_rad.size()) * rig.camera.width *
                         rig.camera.height * 3;
  return prediction;
}

double SpatialSigmaForDensity(double density) {
  constexpr double kLowDensity = 0.02, kLowSigma_px = 20.0;
  constexpr double kHighDensity = 0.05, kHighSigma_px = 15.0;
  static const double exponent =
      std::log(kHighSigma_px / kLowSigma_px) / std::log(kHighDensity / kLowDensity);
  if (!(density > 0.0)) return 60.0;
  return std::clamp(kLowSigma_px * std::pow(density / kLowDensity, exponent), 4.0, 60.0);
}

}  // namespace foresight
