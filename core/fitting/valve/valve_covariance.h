#pragma once

#include "core/fitting/valve/refine.h"

namespace foresight {

/// Replaces the covariance and the deviations of a detection, along and about the object's own
/// axes, by those that hold for the pose: the beams of a scan line err together
/// (CovarianceClusteredByLine), and what no ray tells, that wheels are no template, is a factor for
/// each direction, chosen on training scenes (docs/evaluation/valve.md, "Sigmas of the valve").
/// `footprints` are those of the fit.
void WidenSigmas(const BeamFootprints& footprints, ValveDetection& detection);

}  // namespace foresight
