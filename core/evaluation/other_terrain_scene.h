#pragma once

#include "core/evaluation/fit_trial.h"

namespace foresight {

/// A block's top has the known size where each side is within 15 mm of it; what is not, is another
/// box, whatever it was drawn for.
bool HasBlockSize(const Eigen::Vector3d& size_m);

/// A random scene of the other world (other_world.h: it judges only): heaps and rows of blocks
/// whose sides are off by up to 12 mm, with gaps in them and chipped corners, boxes of other sizes
/// among them, hoses across; or none of the known size. The same seed gives the same scene.
FitTrialScene OtherTerrainScene(std::uint64_t seed);

}  // namespace foresight
