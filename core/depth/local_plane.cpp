#include "core/depth/local_plane.h"

#include <cmath>

#include "core/depth/local_plane_upsampler.h"
#include "core/sensor/scan_plan.h"

namespace foresight {
namespace {

/// Planes need a smaller window than averages: there is no slope to be biased by.
constexpr double kSigmaFraction = 0.6;

}  // namespace

double LocalPlaneSigmaForDensity(double density) {
  return kSigmaFraction * SpatialSigmaForDensity(density);
}

Status LocalPlaneOptions::Check() const {
  const auto positive = [](double value) { return value > 0.0 && std::isfinite(value); };
  if (sigma_spatial_px != 0.0 && !(sigma_spatial_px >= 0.5 && sigma_spatial_px <= 200.0))
    return Fail(ErrorCode::kInvalidOptions,
                "local planes: sigma_spatial_px {} is neither 0 (automatic) nor in [0.5, 200]",
                sigma_spatial_px);
  if (!(radius_in_sigmas >= 0.5 && radius_in_sigmas <= 4.0))
    return Fail(ErrorCode::kInvalidOptions, "local planes: radius_in_sigmas {} is not in [0.5, 4]",
                radius_in_sigmas);
  if (!positive(sigma_color) || !positive(sigma_depth_m) || !positive(ridge))
    return Fail(ErrorCode::kInvalidOptions,
                "local planes: sigma_color {}, sigma_depth_m {} and ridge {} must be positive",
                sigma_color, sigma_depth_m, ridge);
  if (iterations < 1 || iterations > 50)
    return Fail(ErrorCode::kInvalidOptions, "local planes: iterations {} is not in [1, 50]",
                iterations);
  for (const double spacing : {along_line_px, between_lines_px})
    if (!(spacing >= 0.0 && spacing < 1000.0))
      return Fail(ErrorCode::kInvalidOptions, "local planes: spacing {} px is not in [0, 1000)",
                  spacing);
  return {};
}

Result<DenseDepth> UpsampleLocalPlanes(const AlignedSamples& samples, const ColorImage& guide,
                                       const LocalPlaneOptions& options,
                                       const RunContext& context) {
  LocalPlaneUpsampler upsampler(guide, options);
  FORESIGHT_CHECK(upsampler.Update(samples, context));
  return upsampler.TakeDense();
}

}  // namespace foresight
