#pragma once

#include <Eigen/Core>

#include "core/objects/solid_part.h"

namespace foresight {

/// A ray in the frame of a solid, whose middle is the origin; the direction is a unit vector.
struct RayBesideSolid {
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;
};

/// Where a line is nearest to a solid.
struct ClosestApproach {
  double distance_m = 0.0;  ///< negative inside the solid: how deep the line gets
  double range_m = 0.0;     ///< along the ray, from its origin; may be negative
};

/// The closest approach of a line that misses the solid (half its size as for DistanceToSolid), in
/// closed form; beside the edge of a cylinder's end by Newton's method, to a hundredth of a
/// millimetre along the ray.
ClosestApproach ClosestBeside(SolidPart::Shape shape, const RayBesideSolid& ray,
                              const Eigen::Vector3d& half);

/// How deep a line that enters the solid gets: the least signed distance along it, in metres and in
/// closed form.
double DeepestInside(SolidPart::Shape shape, const RayBesideSolid& ray,
                     const Eigen::Vector3d& half);

}  // namespace foresight
