#include "core/fitting/terrain/relabel_planes.h"

#include <algorithm>
#include <cmath>

#include "core/fitting/terrain/plane_grouping.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

constexpr double kNoPlaneCost = 4.0;
constexpr double kMaxCost = 9.0;
constexpr double kAngleSigma_rad = RadiansFromDegrees(12.0);
constexpr double kMaxAngleCost = 3.0;  // normals bend near every edge
constexpr double kUnknownNormalCost = 0.5;
constexpr double kSmoothness = 1.2;
constexpr double kLeastSmoothness = 0.05;
constexpr double kReach_m = 0.060;  // of a plane beyond its points
constexpr int kMaxReach = 12;       // cells
constexpr int kRounds = 2;
constexpr int kSweeps = 2;

double CostOf(const SurfaceGrid& grid, std::span<const Eigen::Vector3d> normals, int i,
              const Plane& plane) {
  const double off = plane.Distance(grid[i].point) / DistanceSigma(grid, i, plane);
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

/// The points within reach of a plane's own, in cells, its own first.
std::vector<int> PointsAround(const SurfaceGrid& grid, const std::vector<int>& own,
                              std::vector<int>& visited, int mark) {
  std::vector<int> around = own;
  double range_m = 0.0;
  for (const int i : own) {
    visited[static_cast<std::size_t>(i)] = mark;
    range_m += grid[i].range_m;
  }
  if (own.empty()) return around;
  range_m /= static_cast<double>(own.size());
  const int rings =
      std::clamp(static_cast<int>(kReach_m / (range_m * grid.step_rad().maxCoeff())), 1, kMaxReach);
  std::size_t begin = 0;
  for (int ring = 0; ring < rings; ++ring) {
    const std::size_t end = around.size();
    for (; begin < end; ++begin)
      for (const auto& [dx, dy] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
        const int j = grid.Neighbor(around[begin], dx, dy);
        if (j < 0 || visited[static_cast<std::size_t>(j)] == mark) continue;
        visited[static_cast<std::size_t>(j)] = mark;
        around.push_back(j);
      }
  }
  return around;
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
  std::vector<std::vector<int>> own(surfaces.planes.size());
  for (int i = 0; i < grid.size(); ++i)
    if (const int label = surfaces.labels[static_cast<std::size_t>(i)]; label >= 0)
      own[static_cast<std::size_t>(label)].push_back(i);
  std::vector<int> visited(static_cast<std::size_t>(grid.size()), -1);
  for (std::size_t k = 0; k < own.size(); ++k)
    for (const int i : PointsAround(grid, own[k], visited, static_cast<int>(k)))
      problem.choices[k + 1].push_back({i, CostOf(grid, normals, i, surfaces.planes[k].plane)});
  AddEdges(grid, problem);
  return problem;
}

Status RelabelPlanes(const SurfaceGrid& grid, std::span<const Eigen::Vector3d> normals,
                     double min_area_m2, SurfacePlanes& surfaces, const RunContext& context) {
  for (int round = 0; round < kRounds; ++round) {
    if (context.Cancelled())
      return Fail(ErrorCode::kCancelled, "fitting the terrain was cancelled");
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
