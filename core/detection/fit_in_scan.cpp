#include "core/detection/fit_in_scan.h"

#include <cmath>

#include "core/fitting/range_noise.h"

namespace foresight {
namespace {

/// Deviation of a range where a region is too small to tell.
constexpr double kRangeSigma_m = 0.010;
/// Neighbouring pixels of a dense map say the same twice.
constexpr int kDepthStride_px = 2;

RaySet WithOwnSigma(RaySet rays) {
  const double sigma_m = EstimateRangeSigma(rays);
  if (std::isfinite(sigma_m)) rays.sigma_m = sigma_m;
  return rays;
}

}  // namespace

Result<RaySet> RaysInScan(const ProcessedScan& scan, FitSource source, const Roi& roi) {
  if (source == FitSource::kRaw)
    return RaysFromScan(scan.cloud, scan.rig, roi, kRangeSigma_m).transform(WithOwnSigma);
  if (scan.depth == nullptr)
    return Fail(ErrorCode::kState,
                "there is no depth map yet; compute it first, or fit to the raw returns");
  const MaskImage& mask = scan.mask != nullptr ? *scan.mask : scan.depth->mask;
  return RaysFromDepth(ApplyMask(scan.depth->dense.depth_m, mask), scan.rig,
                       scan.depth->samples.motor_rad, roi, kDepthStride_px, kRangeSigma_m,
                       LocalDensity(scan.depth->samples));
}

Result<ValveDetection> FitValveInScan(const ProcessedScan& scan, FitSource source, const Roi& roi,
                                      const FitValveOptions& options, const RunContext& context) {
  FORESIGHT_TRY(const RaySet rays, RaysInScan(scan, source, roi));
  FORESIGHT_TRY(ValveDetection detection, FitValve(rays, options, context));
  detection.origin.roi = roi;
  return detection;
}

}  // namespace foresight
