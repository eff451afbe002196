#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/fitting/terrain/surface_planes.h"

namespace foresight {

/// The directions that most normals have, the most frequent first: modes on the sphere within
/// `max_tilt_rad` of `up`. NaN normals do not count.
std::vector<Eigen::Vector3d> FrequentDirections(std::span<const Eigen::Vector3d> normals,
                                                const Eigen::Vector3d& up, double max_tilt_rad);

/// Puts parts of one plane together: a part whose points nearly all lie on a larger plane beside it
/// joins that. Planes are fitted again, those below `min_area_m2` dropped.
void MergeParts(const SurfaceGrid& grid, double min_area_m2, SurfacePlanes& surfaces);

/// Progressive grouping, Section V-B: points by the frequent direction that their normal is nearest
/// to, then by what is connected in one plane, then parts of one plane put together.
SurfacePlanes GroupPlanes(const SurfaceGrid& grid, std::span<const Eigen::Vector3d> normals,
                          const Eigen::Vector3d& up, double max_tilt_rad);

}  // namespace foresight
