#pragma once

#include "core/evaluation/fit_trial.h"

namespace foresight {

/// A door of the other world: panelled, leaning, among other things, and on it a bar or a fitting
/// that is a lever handle where MeasureDoorThing says so. Judges only (other_world.h).
FitTrialScene OtherHandleScene(std::uint64_t seed);

}  // namespace foresight
