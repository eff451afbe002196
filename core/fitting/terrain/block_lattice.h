#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

namespace foresight {

/// Where a block lies, seen from above: metres and radians in any level frame.
struct BlockPlace {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();
  double yaw_rad = 0.0;  ///< of a side; its quarter turns are the same
  double yaw_sigma_rad = 1.0;
};

/// How a block fits between its neighbours.
struct LatticePlace {
  bool in_rows = false;     ///< it stands where the rows say
  BlockPlace place;         ///< what its own edges and its neighbours say together
  double gap_sigmas = 0.0;  ///< its own place against that of the rows; capped at 10
};

/// Blocks laid out in rows, a pitch apart in both directions, each a little off its place.
struct BlockLattice {
  double pitch_m = 0.0;
  double jitter_m = 0.0;             ///< of one block in each direction, estimated
  std::vector<LatticePlace> places;  ///< of the blocks, in their order
};

/// Places the blocks of a field together: fields are built in rows, so that a block whose far edge
/// is hidden is better known from its neighbours than from its own edges. What each block's edges
/// say, `blocks`, is weighed by its covariance against what the rows say, weighed by how far the
/// blocks of this field lie off their rows. nullopt where fewer than 5 blocks are placed by
/// edges, or more than one in five of them does not stand in rows: then nothing is known of
/// neighbours. `side_m`: of a block; the pitch is 0.9 to 1.35 times that. O(blocks).
std::optional<BlockLattice> FindBlockLattice(std::span<const BlockPlace> blocks, double side_m);

}  // namespace foresight
