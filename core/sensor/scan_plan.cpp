#include "core/sensor/scan_plan.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/angles.h"

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
  if (!(exposure_s > 0.0 && exposure_s <= 1.0))
    return Fail(ErrorCode::kInvalidOptions, "scan plan: exposure_s {} is not in (0, 1]",
                exposure_s);
  if (!(gain_db >= 0.0 && gain_db <= 48.0))
    return Fail(ErrorCode::kInvalidOptions, "scan plan: gain_db {} is not in [0, 48]", gain_db);
  if (image_angles_rad.empty() || image_angles_rad.size() > 1000)
    return Fail(ErrorCode::kInvalidOptions,
                "scan plan: {} pictures; between 1 and 1000 are possible", image_angles_rad.size());
  const auto [low, high] = std::minmax(from_rad, to_rad);
  for (const double angle : image_angles_rad)
    if (!(angle >= low - 1e-9 && angle <= high + 1e-9))
      return Fail(ErrorCode::kInvalidOptions,
                  "scan plan: picture at {:.1f} deg is outside the scope {:.1f} to {:.1f} deg",
                  DegreesFromRadians(angle), DegreesFromRadians(low), DegreesFromRadians(high));
  return {};
}

Result<ScanPrediction> PredictScan(const ScanPlan& plan, const SensorRig& rig) {
  FORESIGHT_CHECK(plan.Check());
  FORESIGHT_CHECK(rig.Check());
  ScanPrediction prediction;
  prediction.duration_s = std::abs(plan.to_rad - plan.from_rad) / plan.speed_rad_s;
  prediction.lines = static_cast<int>(std::floor(prediction.duration_s / rig.lidar.period_s));
  // Near the optical axis the image has f pixels a radian.
  prediction.line_spacing_px = plan.speed_rad_s * rig.lidar.period_s * rig.camera.fy;
  prediction.beam_spacing_px = rig.lidar.angle_step_rad * rig.camera.fx;
  prediction.density =
      std::min(1.0, 1.0 / (prediction.line_spacing_px * prediction.beam_spacing_px));
  prediction.sigma_spatial_px = SpatialSigmaForDensity(prediction.density);
  prediction.blur_px = plan.speed_rad_s * plan.exposure_s * rig.camera.fy;
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
