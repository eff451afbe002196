#pragma once

#include <memory>

#include "core/evaluation/fit_trial.h"

namespace foresight {

/// A population's own things under drawn conditions: what may be looked at while something is
/// chosen, where home is too kind and the other world judges only. The things of the other world
/// are in neither.
///
/// Drawn is what a head in the field does not know of its own lidar and of what it looks at; each
/// of these is as at home in one scene of five. Footprint (half to twice ours a side, even or
/// Gaussian), pulse (0.06 to 1.2 m, its range up to three fifths of the way to the leading edge),
/// noise of 4 to 24 mm, up to 2 mm/m and up to 40 mm for weak returns, the tails of Student's t of
/// 3 to 8 degrees of freedom, strays (up to 0.5 %), range walk (up to 15 mm of weak and of black
/// returns), motor errors (up to 2.5 times ours), a rig off by up to 0.15 deg and 4 mm, regions
/// (rectangles and tight boxes). One mesh in four is dark, polished or translucent, one scan in ten
/// interrupted, and in two scenes of five a bent bar is between head and thing.
std::unique_ptr<FitPopulation> MakeVaried(std::unique_ptr<FitPopulation> population);

}  // namespace foresight
