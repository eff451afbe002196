#pragma once

#include <span>
#include <vector>

#include "core/selfcheck/depth_check.h"

namespace foresight {

/// A depth method on beams that stayed out of its map.
struct MethodOnHeldOut {
  DepthMethod method = DepthMethod::kForesight;
  int beams = 0;               ///< that could be compared, the same for all methods
  HeldOutErrors without_mask;  ///< wherever the method has a depth
  HeldOutErrors own_mask;      ///< where its own mask keeps it
  HeldOutErrors our_mask;      ///< where Foresight's mask keeps Foresight's map: equal coverage
  double seconds = 0.0;
};

/// Makes a map of an image by each method with its defaults, from every `keep_one_in`-th line
/// alone, and compares at all the others. Beams that the camera cannot see (Foresight's rejection
/// by all lines) are not compared. Fails as HoldOut does.
Result<std::vector<MethodOnHeldOut>> CompareOnHeldOut(const RegisteredScan& cloud,
                                                      const SensorRig& rig,
                                                      const CameraFrame& frame,
                                                      std::span<const DepthMethod> methods,
                                                      int keep_one_in, const RunContext& context);

}  // namespace foresight
