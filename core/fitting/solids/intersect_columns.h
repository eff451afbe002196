#pragma once

#include <span>
#include <vector>

#include "core/fitting/ray_columns.h"

namespace foresight {

/// A solid at a place, in plain numbers: this header is read where Eigen must not be.
struct PlacedSolid {
  enum class Shape { kBox, kCylinder, kCapsule };

  Shape shape = Shape::kBox;
  double part_from_base[9] = {};  ///< a rotation, row by row
  double offset[3] = {};          ///< of the part's frame: x_part = part_from_base x + offset
  double middle[3] = {};          ///< in base
  double half[3] = {};            ///< half the size; of a round one (radius, radius, half length)
  double bound_m = 0.0;           ///< radius of a sphere round it
};

/// Solids that make one object.
struct PlacedSolids {
  std::vector<PlacedSolid> parts;
  double middle[3] = {};  ///< in base, of a sphere round all
  double bound_m = 0.0;   ///< ... and its radius
};

/// SolidTracer::IntersectWithDepth for many rays at once, in the widest registers that the
/// processor has, a ray a lane; the same numbers on each of them. `clearance_m` and `range_m` have
/// a place for every ray, padded: a clearance is infinite where a ray does not come within its
/// reach.
void IntersectColumns(const PlacedSolids& solids, const RayColumns& rays,
                      std::span<double> clearance_m, std::span<double> range_m);

/// Where each ray first enters one of the solids, as SolidTracer::Intersect without reach; infinite
/// where it misses all.
void EnterColumns(const PlacedSolids& solids, const RayColumns& rays, std::span<double> range_m);

}  // namespace foresight
