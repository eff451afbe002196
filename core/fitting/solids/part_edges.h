#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/objects/solid_part.h"

namespace foresight {

/// A straight piece of an edge, in the part's frame.
struct PartEdge {
  Eigen::Vector3d from;
  Eigen::Vector3d to;
};

/// Where the surface of a part turns away from an eye: all that can be its outline, or hide
/// something behind it. A box has its edges between a face that is seen and one that is not, a
/// cylinder two sides and half of both rims, a capsule two sides and half circles. Circles come as
/// sixteen chords. `eye` is in the part's frame, outside of the part.
std::vector<PartEdge> EdgesSeenFrom(const SolidPart& part, const Eigen::Vector3d& eye);

}  // namespace foresight
