#pragma once

#include "core/fitting/cylinder/cylinder_detection.h"
#include "core/fitting/cylinder/cylinder_state.h"

namespace foresight {

/// Of the beams on a cylinder that the operator drew a box round, how many end in that box.
inline constexpr double kLeastInDrawnBox = 0.5;

/// Never more than LIKELY.
void Assess(const RaySet& rays, const CylinderBounds& bounds, CylinderDetection& detection);

}  // namespace foresight
