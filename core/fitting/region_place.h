#pragma once

#include <Eigen/Core>

#include "core/fitting/ray_set.h"

namespace foresight {

/// An operator draws a region round an object: one further beside its middle is something else.
inline constexpr double kMaxOffCenter_m = 0.15;

/// How far beside the middle of a region, as its rays see it, a point in base lies.
double DistanceFromRegionCenter(const RaySet& region, const Eigen::Vector3d& point);

/// How far a point in base lies from the nearest ray of a region: whether the region shows it.
double DistanceFromRays(const RaySet& region, const Eigen::Vector3d& point);

}  // namespace foresight
