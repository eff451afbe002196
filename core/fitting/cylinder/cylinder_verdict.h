#pragma once

#include "core/fitting/cylinder/cylinder_detection.h"
#include "core/fitting/cylinder/cylinder_state.h"

namespace foresight {

/// Never more than LIKELY.
void Assess(const RaySet& rays, const CylinderBounds& bounds, CylinderDetection& detection);

}  // namespace foresight
