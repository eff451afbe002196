#include "core/fitting/terrain/fit_terrain.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <tuple>

#include "core/fitting/ray_selection.h"
#include "core/fitting/terrain/plane_grouping.h"
#include "core/fitting/terrain/relabel_planes.h"
#include "core/fitting/terrain/surface_collector.h"
#include "core/fitting/terrain/surface_kinds.h"
#include "core/fitting/terrain/surface_normals.h"
#include "core/fitting/terrain/terrain_shift.h"
#include "core/fitting/terrain/terrain_verdict.h"

namespace foresight {
namespace {

constexpr int kMinRays = 60;
constexpr double kMinArea_m2 = 0.01;

Status Cancelled() {
  return Fail(ErrorCode::kCancelled, "fitting the terrain was cancelled");
}

Status CheckRays(const RaySet& rays, const SurfaceGrid& grid) {
  FORESIGHT_CHECK(CheckRayNoise(rays));
  if (grid.size() < kMinRays)
    return Fail(
        ErrorCode::kTooFewPoints,
        "the region holds too few measurements: {}, terrain needs {}: draw it larger, or scan "
        "slower",
        grid.size(), kMinRays);
  return {};
}

/// Blocks that are offered first, then other blocks, then the rest; of each the nearest first.
std::vector<std::size_t> Order(const std::vector<TerrainSurface>& surfaces,
                               const Eigen::Vector3d& viewpoint) {
  std::vector<std::size_t> order(surfaces.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t i) {
    const TerrainSurface& surface = surfaces[i];
    return std::tuple(static_cast<int>(surface.kind),
                      surface.verdict.level == VerdictLevel::kUnsure,
                      (surface.base_from_object.translation() - viewpoint).norm());
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  return order;
}

TerrainDetection Detect(const RaySet& rays, const SurfaceGrid& grid,
                        const FitTerrainOptions& options, const std::vector<FoundSurface>& found) {
  std::vector<TerrainSurface> surfaces;
  std::vector<int> drops;
  for (const FoundSurface& one : found) {
    surfaces.push_back(one.surface);
    drops.push_back(one.evidence.dropping_edges);
  }
  TellGround(options.up, drops, surfaces);
  MeasureSteps(options.up, surfaces);
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if (surfaces[i].kind == TerrainSurface::Kind::kBlock)
      surfaces[i].verdict = AssessBlock(rays, surfaces[i], found[i].evidence);
    else
      surfaces[i].toehold.size_m.setZero();
  }
  TerrainDetection detection;
  detection.labels.assign(rays.rays.size(), -1);
  for (const std::size_t i : Order(surfaces, grid.viewpoint())) {
    for (const int point : found[i].points)
      detection.labels[static_cast<std::size_t>(grid[point].ray)] =
          static_cast<int>(detection.surfaces.size());
    detection.surfaces.push_back(std::move(surfaces[i]));
  }
  detection.verdict = AssessTerrain(detection.surfaces);
  return detection;
}

}  // namespace

Status FitTerrainOptions::Check() const {
  if (!(block_size_m.minCoeff() >= 0.05) || !(block_size_m.maxCoeff() <= 2.0))
    return Fail(ErrorCode::kInvalidOptions,
                "terrain fit: block_size_m {} x {} is not within 0.05 to 2", block_size_m.x(),
                block_size_m.y());
  if (!up.allFinite() || std::abs(up.norm() - 1.0) > 1e-6)
    return Fail(ErrorCode::kInvalidOptions, "terrain fit: up ({}, {}, {}) has not length 1", up.x(),
                up.y(), up.z());
  if (!(max_tilt_rad > 0.0 && max_tilt_rad <= 1.2))
    return Fail(ErrorCode::kInvalidOptions, "terrain fit: max_tilt_rad {} is not in (0, 1.2]",
                max_tilt_rad);
  if (!(toehold_margin_m >= 0.0))
    return Fail(ErrorCode::kInvalidOptions, "terrain fit: toehold_margin_m {} is below 0",
                toehold_margin_m);
  if (max_rays < kMinRays)
    return Fail(ErrorCode::kInvalidOptions, "terrain fit: max_rays {} is below {}", max_rays,
                kMinRays);
  return {};
}

Result<TerrainDetection> FitTerrain(const RaySet& rays, const FitTerrainOptions& options,
                                    const RunContext& context) {
  const auto begin = std::chrono::steady_clock::now();
  FORESIGHT_CHECK(options.Check());
  context.Report(0.0, "looking at the surfaces");
  const SurfaceGrid grid(rays, options.max_rays);
  FORESIGHT_CHECK(CheckRays(rays, grid));
  const std::vector<Eigen::Vector3d> normals = SurfaceNormals(grid, context);
  if (context.Cancelled()) return tl::unexpected(Cancelled().error());

  context.Report(0.3, "grouping planes");
  SurfacePlanes planes = GroupPlanes(grid, normals, options.up, options.max_tilt_rad);
  if (planes.planes.empty())
    return Fail(ErrorCode::kNoConvergence,
                "no plane that can be stood on lies in the region: draw it around the blocks");
  context.Report(0.4, "cutting planes apart");
  if (options.graph_cut)
    FORESIGHT_CHECK(RelabelPlanes(grid, normals, kMinArea_m2, planes, context));

  context.Report(0.6, "fitting blocks");
  SurfaceCollector collector(rays, grid, options);
  for (int plane = 0; plane < static_cast<int>(planes.planes.size()); ++plane) {
    if (context.Cancelled()) return tl::unexpected(Cancelled().error());
    collector.Add(planes, plane);
  }
  if (options.place_together) collector.PlaceTogether();
  collector.PlaceByImage();
  collector.MeasureSizes();
  TerrainDetection detection = Detect(rays, grid, options, collector.found);
  if (options.last) MarkShifts(*options.last, detection.surfaces);
  detection.origin.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  context.Report(1.0, "terrain fitted");
  return detection;
}

}  // namespace foresight
