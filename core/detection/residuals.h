#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/detection/detection.h"
#include "core/fitting/ray_set.h"

namespace foresight {

/// How far a measured range is from what the candidate's template predicts.
struct Residual {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< measured, in base
  double ahead_m = 0.0;  ///< along the ray: above 0 the template lies behind the point
};

/// Of the rays that intersect the candidate's template (of terrain: any surface's rectangle) and
/// whose range agrees with it to within 100 mm; others say nothing about the pose. O(rays x parts
/// of the template).
std::vector<Residual> ResidualsOf(const Detection& detection, int candidate, const RaySet& rays);

}  // namespace foresight
