#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/geometry/rigid.h"
#include "core/mapping/map_frame.h"

namespace foresight {

struct AlignCloudsOptions {
  /// Clouds are thinned to one point, the mean, a cell of this size.
  double voxel_m = 0.05;
  /// How far a point may be from its partner, stage by stage: wide enough for what the first guess
  /// may be off, then for what is left.
  std::array<double, 3> reach_m = {0.30, 0.12, 0.06};
  int max_iterations = 40;  ///< a stage
  /// Of the thinned points that must find a partner in the end.
  double min_overlap_ratio = 0.25;
  /// A direction of which the sigma is larger is not determined.
  double max_sigma_m = 0.010;
  double max_sigma_rad = 0.005;

  Status Check() const;  ///< Fails with kInvalidOptions.
};

/// How one cloud lies in another.
struct CloudAlignment {
  Rigid<frame::Map, frame::Robot> map_from_robot;
  double rms_m = 0.0;          ///< distance of points from their partners' planes
  double overlap_ratio = 0.0;  ///< of the thinned points that have a partner within the last reach
  std::size_t points = 0;      ///< thinned, that have one
  /// Standard deviation of the best and the least determined direction, from the planes that were
  /// met: in metres at the cloud's centre for shifts, radians for turns.
  double largest_sigma_m = 0.0;
  double largest_sigma_rad = 0.0;
  /// The least determined shift, in map: along a corridor, say.
  Eigen::Vector3d weakest_shift = Eigen::Vector3d::Zero();
  /// What could not be aligned, one sentence each; empty = everything is determined.
  std::vector<std::string> undetermined;
};

/// Generalised ICP (PCL) of `moving`, points in robot, to `reference`, points in map, from a first
/// guess. Fails with kTooFewPoints (fewer than 200 thinned points), kNoConvergence where less than
/// `min_overlap_ratio` finds a partner, and kCancelled. Metres. O(points log points).
Result<CloudAlignment> AlignClouds(std::span<const Eigen::Vector3f> reference,
                                   std::span<const Eigen::Vector3f> moving,
                                   const Rigid<frame::Map, frame::Robot>& guess,
                                   const AlignCloudsOptions& options, const RunContext& context);

}  // namespace foresight
