#pragma once

#include "core/fitting/drill/drill_state.h"
#include "core/fitting/ray_set.h"

namespace foresight {

/// Standard deviations and covariance of the detection, along and about the object's own axes.
/// Beams of a scan line err together (CovarianceClusteredByLine), the table is known as its rays
/// are scattered. What no ray tells, that drills are no templates, is a factor and an addition for
/// each direction, chosen on training scenes (docs/evaluation/drill.md, "The drill a fourth time").
/// @returns the deviation of the yaw as independent beams would have it, radians: the verdict's
/// weights were fitted to that.
double SetSigmas(const RaySet& rays, const DrillState& drill, const TableFrame& base_from_table,
                 const DrillPrior& prior, DrillDetection& detection);

}  // namespace foresight
