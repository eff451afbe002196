#pragma once

#include <optional>

#include "core/fitting/roi.h"
#include "core/fitting/valve/valve_detection.h"
#include "core/simulation/world.h"

namespace foresight {

/// The rectangle that an operator would draw round a scene's valve in the image taken at
/// `motor_rad`; nullopt when it does not appear there.
std::optional<ImageRoi> RegionOfTrueValve(const ValveTruth& valve, const World& world,
                                          double motor_rad);

/// How far a fit is from the truth.
struct ValveError {
  double center_m = 0.0;  ///< between the centres of the rims
  double axis_rad = 0.0;
  double radius_m = 0.0;
  int spokes = 0;  ///< found minus true
};
ValveError CompareWithTruth(const ValveCandidate& found, const ValveTruth& truth,
                            const World& world);

}  // namespace foresight
