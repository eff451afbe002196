#pragma once

#include "core/fitting/cylinder/cylinder_detection.h"
#include "core/fitting/cylinder/cylinder_state.h"

namespace foresight {

/// The least fraction of the beams on a cylinder that end in the box that the operator drew.
inline constexpr double kLeastInDrawnBox = 0.5;

/// Never more than LIKELY.
void Assess(const RaySet& rays, const CylinderBounds& bounds, CylinderDetection& detection);

}  // namespace foresight
