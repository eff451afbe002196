#pragma once

#include <vector>

#include "core/selfcheck/error_spread.h"
#include "core/selfcheck/held_out_beams.h"

namespace foresight {

/// The map's own error where neighbouring lines stayed out, each with a draw of the noise in it.
/// Over four neighbouring beams of two neighbouring lines the map is off by about the same, while
/// each line has its own noise: that of its beams, and what it is off by as a whole (the motor's
/// encoder). The mean of both lines is the error, with as much noise as half their difference
/// shows. Where the eight differ by more than noise can explain, by RightWithin_m and by 6
/// deviations of the beams at that distance, the map's error is larger than any noise: it counts as
/// it is. Only beams that the mask keeps count; lines without a neighbour that stayed out say
/// nothing. O(n log n).
std::vector<NoisyError> MapErrors(const std::vector<HeldOutBeam>& lines);

}  // namespace foresight
