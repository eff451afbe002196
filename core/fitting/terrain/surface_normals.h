#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/base/run_context.h"
#include "core/fitting/terrain/surface_grid.h"

namespace foresight {

/// The normal at each point of a grid, towards the viewer; NaN where too few neighbours say.
/// A plane of inverse depth over a metric window, found on the grid; points more than 1.5 windows
/// nearer or farther do not count, and one re-weighting spares it the other side of an edge.
/// Empty when the context was cancelled. O(points * window).
std::vector<Eigen::Vector3d> SurfaceNormals(const SurfaceGrid& grid, const RunContext& context);

}  // namespace foresight
