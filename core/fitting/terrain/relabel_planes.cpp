#include "core/fitting/terrain/relabel_planes.h"

#include <algorithm>
#include <cmath>

#include "core/fitting/terrain/crease_slivers.h"
#include "core/fitting/terrain/plane_grouping.h"
#include "core/fitting/terrain/plane_reach.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

constexpr double kNoPlaneCost = 4.0;
constexpr double kMaxCost = 9.0;
constexpr double kAngleSigma_rad = RadiansFromDegrees(12.0);
constexpr double kMaxAngleCost = 2.0;    // normals bend near every edge
constexpr double kLeastSigma_m = 0.002;  // of a point from the plane that it lies on
constexpr double kUnknownNormalCost = 0.5;
constexpr double kSmoothness = 1.2;
constexpr double kLeastSmoothness = 0.05;
constexpr int kRounds = 2;
constexpr int kSweeps = 2;

double CostOf(const SurfaceGrid& grid, std::span<const Eigen::Vector3d> normals, int i,
              const SurfacePlane& surface) {
  const Plane& plane = surface.plane;
  // A dense map is smoother than its ranges are certain, and beside a crease the smooth part
  // decides which of two planes a point lies on.
  const double sigma_m =
      std::min(DistanceSigma(grid, i, plane), std::max(kLeastSigma_m, surface.rms_m));
  const double off = plane.Distance(grid[i].point) / sigma_m;
  double cost = 0.5 * off * off;
  if (cost >= kMaxCost) return kMaxCost;
  const Eigen::Vector3d& normal = normals[static_cast<std::size_t>(i)];
  if (normal.allFinite()) {
    const double turn =
        std::acos(std::clamp(normal.dot(plane.normal), -1.0, 1.0)) / kAngleSigma_rad;
    cost += std::min(0.5 * turn * turn, kMaxAngleCost);
  } else {
    cost += kUnknownNormalCost;
  }
  return std::min(cost, kMaxCost);
}

void AddEdges(const SurfaceGrid& grid, LabelProblem& problem) {
  const double gate_m = std::max(0.030, 3.0 * grid.sigma_m());
  for (int i = 0; i < grid.size(); ++i)
    for (const auto& [dx, dy] : {std::pair(1, 0), {0, 1}}) {
      const int j = grid.Neighbor(i, dx, dy);
      if (j < 0) continue;
      const double step = (grid[j].range_m - grid[i].range_m) / gate_m;
      problem.edges.push_back(
          {i, j, kSmoothness * std::exp(-0.5 * step * step) + kLeastSmoothness});
    }
}

}  // namespace

LabelProblem PlaneLabelProblem(const SurfaceGrid& grid, std::span<const Eigen::Vector3d> normals,
                               const SurfacePlanes& surfaces) {
  LabelProblem problem;
  problem.nodes = grid.size();
  problem.choices.resize(surfaces.planes.size() + 1);
  for (int i = 0; i < grid.size(); ++i) problem.choices[0].push_back({i, kNoPlaneCost});
  const std::vector<std::vector<int>> own = PointsOfEach(surfaces);
  PlaneReach reach(grid);
  for (std::size_t k = 0; k < own.size(); ++k)
    for (const int i : reach.Around(own[k]))
      problem.choices[k + 1].push_back({i, CostOf(grid, normals, i, surfaces.planes[k])});
  AddEdges(grid, problem);
  return problem;
}

Status RelabelPlanes(const SurfaceGrid& grid, std::span<const Eigen::Vector3d> normals,
                     double min_area_m2, SurfacePlanes& surfaces, const RunContext& context) {
  for (int round = 0; round < kRounds; ++round) {
    if (context.Cancelled())
      return Fail(ErrorCode::kCancelled, "fitting the terrain was cancelled");
    DissolveCreaseSlivers(grid, min_area_m2, surfaces);
    const LabelProblem problem = PlaneLabelProblem(grid, normals, surfaces);
    std::vector<int> labels = surfaces.labels;
    for (int& label : labels) ++label;
    ExpandLabels(problem, kSweeps, labels);
    for (int& label : labels) --label;
    surfaces.labels = std::move(labels);
    RefitPlanes(grid, min_area_m2, surfaces);
    MergeParts(grid, min_area_m2, surfaces);
  }
  return {};
}

}  // namespace foresight
