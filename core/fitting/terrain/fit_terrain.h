#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>

#include "core/base/run_context.h"
#include "core/fitting/ray_set.h"
#include "core/fitting/terrain/terrain_detection.h"
#include "core/geometry/angles.h"

namespace foresight {

struct FitTerrainOptions {
  Eigen::Vector2d block_size_m = {0.397, 0.390};   ///< two standard cinder blocks side by side
  Eigen::Vector3d up = -Eigen::Vector3d::UnitY();  ///< against gravity, in base, length 1
  double max_tilt_rad = RadiansFromDegrees(45.0);  ///< of a surface
  double toehold_margin_m = 0.020;                 ///< kept from each side of a block
  bool graph_cut = true;  ///< false: planes stay as they grew (for comparison)
  bool place_together =
      true;               ///< false: each block by itself, without its neighbours (for comparison)
  int max_rays = 120000;  ///< a denser region is thinned to this many
  /// The last accepted answer; blocks that moved since are marked (both in base, the robot
  /// unmoved).
  std::shared_ptr<const TerrainDetection> last;
  std::uint64_t seed = 1;

  Status Check() const;
};

/// Finds the blocks that can be stood on, Section V-B: normals on a metric window, progressive
/// grouping, alpha-expansion graph cut, refits, rectangles of the known size, edges. Blocks that
/// `rays.image` shows are placed on its edges and measured with them. The same rays,
/// options and seed give the same answer on any number of threads. A region without a block is no
/// error: it has ground and unknown surfaces only. Fails with kTooFewPoints, kNoConvergence (no
/// plane at all), kInvalidInput, kInvalidOptions and kCancelled. Below a second of CPU for
/// max_rays.
Result<TerrainDetection> FitTerrain(const RaySet& rays, const FitTerrainOptions& options,
                                    const RunContext& context);

}  // namespace foresight
