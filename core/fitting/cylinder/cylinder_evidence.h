#pragma once

#include "core/fitting/cylinder/cylinder_detection.h"
#include "core/fitting/cylinder/cylinder_state.h"

namespace foresight {

/// The rays' deviation from a cylinder: from the median of the hits' differences of at most 0.15 m,
/// between 3 and 60 mm. NaN for fewer than 12 hits.
double RangeSigmaFrom(const RaySet& rays, const CylinderState& cylinder);

/// Whether a measurement ends in the box that the operator drew, give or take `within_m` along its
/// ray: a box drawn tightly ends among the noise of the ranges on its front. False without a box.
bool EndsInDrawnBox(const RaySet& rays, const RangeRay& ray, double within_m);

/// Hits, agreement, beams through it and the arc that is seen; `box_margin_nats` is left alone.
CylinderEvidence GatherEvidence(const RaySet& rays, const CylinderState& cylinder);

/// Deviations of radius, place and direction, from how the hits' ranges and the grazing rays'
/// clearances change with them.
void SetSigmas(const RaySet& rays, const CylinderState& cylinder, CylinderDetection& detection);

}  // namespace foresight
