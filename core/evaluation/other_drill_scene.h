#pragma once

#include "core/evaluation/fit_trial.h"

namespace foresight {

/// A random scene of the other world (other_world.h: it judges only) with a tool on a table.
/// Whether it is a drill is measured on its meshes (ToolMeasures); `what` has the drawing's name,
/// and "by its shape a drill" or "by its shape no drill" where that says otherwise. The same seed
/// gives the same scene.
FitTrialScene OtherDrillScene(std::uint64_t seed);

}  // namespace foresight
