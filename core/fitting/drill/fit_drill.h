#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/base/run_context.h"
#include "core/fitting/drill/drill_detection.h"
#include "core/fitting/ray_set.h"
#include "core/geometry/angles.h"
#include "core/objects/drill_template.h"

namespace foresight {

struct FitDrillOptions {
  std::vector<DrillTemplate> templates = ShippedDrillTemplates();  ///< each is tried
  Eigen::Vector3d up = -Eigen::Vector3d::UnitY();        ///< against gravity, in base, length 1
  double max_table_tilt_rad = RadiansFromDegrees(15.0);  ///< from level
  double max_body_tilt_rad = RadiansFromDegrees(15.0);
  int max_rays = 1200;  ///< a denser region is thinned to this many
  std::uint64_t seed = 1;

  Status Check() const;
};

/// Finds one drill that stands in a region, Section V-B: table, walls behind, body, then yaw and
/// scale of each template by how well it explains every ray, with an explicit test of the flipped
/// drill and against a free box and cylinder. The pose is in base, its frame that of DrillModel.
/// The same rays, options and seed give the same answer on any number of threads. Fails with
/// kTooFewPoints, kNoConvergence (nothing like a drill in it), with a message that says what to do,
/// kInvalidOptions and kCancelled. Below a second.
Result<DrillDetection> FitDrill(const RaySet& rays, const FitDrillOptions& options,
                                const RunContext& context);

}  // namespace foresight
