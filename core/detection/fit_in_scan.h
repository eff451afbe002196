#pragma once

#include "core/depth/pipeline.h"
#include "core/fitting/valve/fit_valve.h"

namespace foresight {

/// What a fit is given to look at.
enum class FitSource {
  kRaw,    ///< the lidar's returns with their own rays
  kDepth,  ///< the masked dense depth
};

/// A scan as far as it has been processed. Nothing is owned.
struct ProcessedScan {
  const SensorRig& rig;
  const RegisteredScan& cloud;
  const DepthResult* depth = nullptr;  ///< needed for kDepth
  const MaskImage* mask = nullptr;     ///< instead of depth->mask, where a threshold was moved
};

/// The rays of a region with the noise and the thinning that belong to the source. Fails as
/// RaysFromScan and RaysFromDepth do, and with kState for kDepth without a depth.
Result<RaySet> RaysInScan(const ProcessedScan& scan, FitSource source, const Roi& roi);

/// From a region to a valve, with the noise and the thinning that belong to the source: the one way
/// that every program takes, so that a number never differs between them. The region is noted in
/// the result. Fails as RaysFromScan, RaysFromDepth and FitValve do, and with kState for kDepth
/// without a depth.
Result<ValveDetection> FitValveInScan(const ProcessedScan& scan, FitSource source, const Roi& roi,
                                      const FitValveOptions& options, const RunContext& context);

}  // namespace foresight
