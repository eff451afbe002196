#pragma once

#include "core/base/run_context.h"
#include "core/fitting/ray_set.h"
#include "core/fitting/valve/valve_detection.h"

namespace foresight {

struct FitValveOptions {
  double min_rim_radius_m = 0.045;
  double max_rim_radius_m = 0.240;
  int min_spokes = 2;
  int max_spokes = 6;
  int circle_trials = 6000;  ///< three-point circles tried
  int max_rays = 1500;       ///< a denser region is thinned to this many
  std::uint64_t seed = 1;

  Status Check() const;
};

/// Finds one wheel valve among the rays of a region, Section V-B: wall, rim circle, then the
/// template as a disc and with each number of spokes, compared by how well it explains every ray,
/// those that pass through the wheel included. The pose is in base; z of the object points to the
/// viewer, x along the spoke that is nearest to up (-y of base). `roi` stays empty: the caller
/// knows it. The same rays, options and seed give the same answer on any number of threads. Fails
/// with kTooFewPoints (a region with too few rays), kNoConvergence (nothing like a wheel in it),
/// with a message that says what to do, and kCancelled. About half a second.
Result<ValveDetection> FitValve(const RaySet& rays, const FitValveOptions& options,
                                const RunContext& context);

}  // namespace foresight
