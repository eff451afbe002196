#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "core/base/run_context.h"
#include "core/fitting/cylinder/cylinder_detection.h"
#include "core/fitting/ray_set.h"

namespace foresight {

struct FitCylinderOptions {
  double min_radius_m = 0.010;
  double max_radius_m = 0.600;
  Eigen::Vector3d up = -Eigen::Vector3d::UnitY();  ///< in base, length 1: which way z points
  int max_rays = 1500;                             ///< a denser region is thinned to this many
  std::uint64_t seed = 1;

  Status Check() const;
};

/// Finds one cylinder of any direction, radius and length in a region: circles in many directions,
/// then the likelihood of every ray (BeamLikelihood), before the flat surfaces that are there.
/// Only the half that faces the sensor is seen, which leaves a least-squares circle's radius open;
/// the beams that went past on both sides close it, so give BoxRays::kPassThrough for a box. The
/// ranges' deviation is found with the cylinder, from 3 to 60 mm: what a scanner says it is rarely
/// is, and real poles are not smooth. The same rays, options and seed give the same answer on any
/// number of threads. Fails with kTooFewPoints, kNoConvergence (nothing round in it),
/// kInvalidInput, kInvalidOptions and kCancelled. About a second.
Result<CylinderDetection> FitCylinder(const RaySet& rays, const FitCylinderOptions& options,
                                      const RunContext& context);

}  // namespace foresight
