#pragma once

#include <cstdint>

#include "core/evaluation/fit_trial.h"

namespace foresight {

/// The region that an operator draws round the object of a trial's scene, in the scene's style; a
/// box lies in the base of `world`'s true head. The seed draws how well. Fails with kInvalidInput
/// where nothing of it is in the image.
Result<Roi> DrawnRegion(const FitTrialScene& scene, const World& world, double motor_rad,
                        std::uint64_t seed);

}  // namespace foresight
