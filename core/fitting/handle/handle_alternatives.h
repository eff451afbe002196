#pragma once

#include <string>
#include <vector>

#include "core/base/run_context.h"
#include "core/fitting/handle/handle_state.h"

namespace foresight {

/// Something else that may sit where a handle was found.
struct HandleAlternative {
  std::string name;  ///< "knob", "pull bar", "bow", "bar on a post", "box"
  int parameters = 0;
  double log_likelihood = 0.0;
};

/// The best of each kind in the handle's place, or where the points are, which are in the door's
/// frame. On a long plate where the handle has one: a strip that stands out may be a door's frame,
/// and is no reason to take what is before it for a lever. Those of a cancelled context mean
/// nothing.
std::vector<HandleAlternative> FitHandleAlternatives(
    const BeamLikelihood& likelihood, const DoorFrame& base_from_door, const HandleState& handle,
    const std::vector<Eigen::Vector3d>& before_door, const RunContext& context);

}  // namespace foresight
