#pragma once

#include "core/evaluation/fit_trial.h"

namespace foresight {

/// A random scene of the other world (other_world.h: it judges only) with a handwheel or a flat
/// lever on a valve's body, or with something that has a rim and is no handwheel. Which it is, is
/// measured on the mesh (WheelMeasures); `what` has the drawing's name and, of handwheels, what was
/// measured. The same seed gives the same scene.
FitTrialScene OtherValveScene(std::uint64_t seed);

}  // namespace foresight
