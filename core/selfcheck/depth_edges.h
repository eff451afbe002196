#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/registration/register_scan.h"

namespace foresight {

/// Where a near surface ends before a far one.
struct DepthEdge {
  Eigen::Vector3d point;   ///< half a step beyond the last return of the near surface, in base
  Eigen::Vector3d across;  ///< a step from the near to the far surface, in base, metres
  /// From where the same surface ends on the lines before to where it does on the lines after, in
  /// base, metres; zero where it was not asked for.
  Eigen::Vector3d along;
  double jump_m = 0.0;
};

struct DepthEdgeOptions {
  double least_jump_m = 0.12;
  double least_jump_of_range = 0.06;
  double most_jump_m = 5.0;  ///< more is a beam that met nothing for long, or a spike
  /// Both sides must be smooth: their own step is less than the jump by this factor.
  double least_jump_of_slope = 4.0;
  bool near_alone = false;  ///< only the near side must be smooth: ground and bushes lie behind
  /// Only edges that run on over neighbouring lines, each with its direction. Beams that are narrow
  /// do not need it: their edges lie where they are, whichever way these run.
  bool on_several_lines = true;

  /// For other lidars, whose beams are narrow and reach far.
  static DepthEdgeOptions OfImported();
};

/// The depth edges between neighbouring beams of a line. Those between neighbouring lines are left
/// alone: a beam is 12 mrad high, and surfaces seen at a small angle end half of that early while
/// others end late, which looks like a turn of 0.3 deg about the motor's axis. O(points).
std::vector<DepthEdge> FindDepthEdges(const RegisteredScan& cloud, const DepthEdgeOptions& options);

}  // namespace foresight
