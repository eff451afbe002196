#pragma once

#include <cstdint>

#include "core/base/run_context.h"
#include "core/fitting/handle/handle_detection.h"
#include "core/fitting/ray_set.h"

namespace foresight {

struct FitHandleOptions {
  double min_length_m = 0.080;  ///< from the pivot's axis to the end
  double max_length_m = 0.180;
  int pair_trials = 300;  ///< bars through two points tried
  int max_rays = 4000;    ///< a denser region is thinned to this many
  std::uint64_t seed = 1;

  Status Check() const;
};

/// Finds one door handle in a region: the door's plane, what stands 20 to 110 mm before it, bars
/// through pairs of those points with the pivot at either end, then the beam model of every ray
/// (BeamLikelihood), with straight and returned ends, a rosette and a long plate, against a knob, a
/// pull bar, a bow, a bar on a post and a box. The pose is in base, its frame that of HandleModel;
/// its z is the door's normal. The same rays, options and seed give the same answer on any number
/// of threads. Fails with kTooFewPoints, kNoConvergence (no door, nothing like a lever before it),
/// with a message that says what to do, kInvalidOptions and kCancelled. About half a second.
Result<HandleDetection> FitHandle(const RaySet& rays, const FitHandleOptions& options,
                                  const RunContext& context);

}  // namespace foresight
