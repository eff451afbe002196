#pragma once

#include <string>
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

enum class HandleEffort { kCoarse, kFine };

/// Climbs the score over all parameters; with kFine also over straight and returned ends, both
/// plates and pivots further along the lever. The result's score is never below the start's.
HandleState LocalSearch(const HandleScorer& scorer, HandleState start, HandleEffort effort);

/// The best lever that is `longer_m` longer (negative: shorter): its free end is where the lever's
/// is, or its pivot is, or its pivot alone is elsewhere on the bar; minus infinity where none of
/// that length is built.
HandleState OtherLength(const HandleScorer& scorer, const HandleState& lever, double longer_m);

/// Something else that may sit there.
struct HandleAlternative {
  std::string name;  ///< "knob", "pull bar", "bow", "bar on a post", "box"
  int parameters = 0;
  double log_likelihood = 0.0;
};

/// The best of each kind in the handle's place, or where the points are. Those of a cancelled
/// context mean nothing.
std::vector<HandleAlternative> FitHandleAlternatives(
    const BeamLikelihood& likelihood, const DoorFrame& base_from_door, const HandleState& handle,
    const std::vector<Eigen::Vector3d>& before_door, const RunContext& context);

}  // namespace foresight
