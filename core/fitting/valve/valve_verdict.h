#pragma once

#include "core/fitting/valve/fit_valve.h"
#include "core/fitting/valve/valve_state.h"

namespace foresight {

/// Whether a wheel's rim has a radius that was asked for, but for a tenth; levers have none.
bool HasSize(const ValveModel& model, const FitValveOptions& options);

/// How far an operator may trust a detection whose evidence, sigmas and candidates are filled in.
///
/// The probability is that of the shipped verdict model of lidar returns or of dense maps. Hard
/// gates keep what no probability should: a confirmed valve has enough measurements on it, is not
/// seen through and open where it should be, lies near the region's centre, has spokes, no
/// alternative close behind and no size at a bound. Discs and levers are never confirmed: too many
/// things are round or straight. See-through beyond a quarter, or a rim out of range, is never even
/// likely. `rays` are those it was fitted to, of the region that the operator drew.
Verdict AssessValve(const RaySet& rays, const RaySet& region, const ValveDetection& detection,
                    const FitValveOptions& options);

}  // namespace foresight
