#pragma once

#include <Eigen/Core>
#include <span>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/fitting/terrain/label_expansion.h"
#include "core/fitting/terrain/surface_planes.h"

namespace foresight {

/// The labels of a grid's points as a graph: label 0 is none, label k + 1 plane k. A point pays for
/// its distance from a plane in sigmas (of its range or the rms of the plane's points, the smaller)
/// and for its normal's angle to it, at most a fixed cost;
/// planes reach only a little beyond their points. Neighbours at the same range pay more for a
/// difference than those across an edge of depth.
LabelProblem PlaneLabelProblem(const SurfaceGrid& grid, std::span<const Eigen::Vector3d> normals,
                               const SurfacePlanes& surfaces);

/// Group labels refined by Graph Cut, Section V-B: expansions and refits in turn,
/// without the slivers at creases. Fails with
/// kCancelled.
Status RelabelPlanes(const SurfaceGrid& grid, std::span<const Eigen::Vector3d> normals,
                     double min_area_m2, SurfacePlanes& surfaces, const RunContext& context);

}  // namespace foresight
