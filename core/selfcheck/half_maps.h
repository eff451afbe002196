#pragma once

#include <vector>

#include "core/selfcheck/held_out_beams.h"

namespace foresight {

/// What noise does to a depth map, at each pixel that `shown` has (not 0): draws of the error, of
/// either sign as a size, metres. Two maps of the image are made that have no line in common, one
/// of the even and one of the odd lines; what the ranges and the motor's angle of a line are off by
/// is independent in both. Where the method's window follows the density, each of them averages as
/// many samples as the map of all lines does, so its error spreads as (even - odd) / sqrt(2) does;
/// with a fixed window as (even - odd) / 2. What all lines share does not show: a bias of the
/// ranges, a smoothed corner.
/// Fails as ComputeDepth does. Costs two depth maps.
Result<std::vector<double>> NoiseOfMap(const JudgedBeams& beams, const ColorImage& guide,
                                       const DepthOptions& options, const MaskImage& shown,
                                       const RunContext& context);

}  // namespace foresight
