#pragma once

#include <vector>

#include "core/base/random.h"
#include "core/base/run_context.h"
#include "core/fitting/handle/handle_state.h"

namespace foresight {

/// Levers worth a local search, the best first and no two alike: bars through two of the points,
/// which are in the door's frame, with the pivot at either end. Empty in a cancelled context.
std::vector<HandleState> FindLevers(const HandleScorer& scorer,
                                    const std::vector<Eigen::Vector3d>& before_door, Random& random,
                                    const RunContext& context);

enum class HandleEffort { kCoarse, kFine, kFinest };

/// Climbs the score over all parameters but how the lever is bowed; with kFine also over straight
/// and returned ends, both plates and pivots further along the lever, with kFinest over bows, too.
/// The result's score is never below the start's.
HandleState LocalSearch(const HandleScorer& scorer, HandleState start, HandleEffort effort);

/// The best lever that is `longer_m` longer (negative: shorter): its free end is where the lever's
/// is, or its pivot is, or its pivot alone is elsewhere on the bar, by as much, twice or three
/// times as much; minus infinity where none of these is built.
HandleState OtherLength(const HandleScorer& scorer, const HandleState& lever, double longer_m);

}  // namespace foresight
