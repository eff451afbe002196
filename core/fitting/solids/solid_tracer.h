#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/fitting/ray_set.h"
#include "core/fitting/solids/intersect_columns.h"
#include "core/objects/solid_part.h"

namespace foresight {

/// How a ray passes some solids.
struct SolidIntersection {
  /// Least distance between ray and solids; negative when the ray enters one: how deep.
  double clearance_m = 0.0;
  double range_m = 0.0;  ///< where the ray enters the first solid, or passes it closest
  int part = -1;         ///< which; -1 = none within reach

  bool Hits() const { return clearance_m < 0.0; }
};

/// Solids at a place, made ready for many rays: closed forms where a ray enters, and a bounding
/// sphere that saves most of the work.
class SolidTracer {
 public:
  SolidTracer(std::span<const SolidPart> parts,
              const Rigid<frame::Base, frame::Object>& base_from_object);

  /// What the ray intersects, or misses by at most `reach_m`. A hit's clearance is not measured: -1
  /// m.
  SolidIntersection Intersect(const RangeRay& ray, double reach_m) const;
  /// The same with a hit's depth: how far the ray gets inside the solid that it enters first, or
  /// inside another that it enters within 20 mm of that, `reach_m` at most. Solids that only touch
  /// keep the edge between them.
  SolidIntersection IntersectWithDepth(const RangeRay& ray, double reach_m) const;
  /// For IntersectColumns, which does the same.
  PlacedSolids Placed() const;

 private:
  struct Part {
    SolidPart::Shape shape;
    Eigen::Matrix3d part_from_base;
    Eigen::Vector3d offset;
    Eigen::Vector3d middle;  ///< in base
    Eigen::Vector3d half;    ///< half the size; of a round one (radius, radius, half length)
    double bound_m;          ///< radius of the sphere round it
  };

  SolidIntersection Passed(const RangeRay& ray, double reach_m) const;

  std::vector<Part> parts_;
  Eigen::Vector3d middle_ = Eigen::Vector3d::Zero();  ///< of a sphere round all
  double bound_m_ = 0.0;
};

}  // namespace foresight
