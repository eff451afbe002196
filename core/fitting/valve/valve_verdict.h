#pragma once

#include "core/fitting/valve/fit_valve.h"
#include "core/fitting/valve/valve_state.h"

namespace foresight {

/// How far an operator may trust a detection whose evidence, sigmas and candidates are filled in.
///
/// The probability is a logistic function of the evidence; its weights are provisional, set on
/// synthetic views (tests/core/fitting) until they are calibrated on recorded ones. Hard gates
/// keep what no probability should: a confirmed wheel was fitted to lidar returns, has enough rays
/// on it, is not seen through, lies near the region's centre, has spokes, no rival number of spokes
/// close behind, and no parameter at a bound.
Verdict AssessValve(const RaySet& rays, const ValveDetection& detection,
                    const FitValveOptions& options);

}  // namespace foresight
