#include "core/fitting/terrain/fit_terrain.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <span>

#include "core/fitting/ray_selection.h"
#include "core/fitting/terrain/block_evidence.h"
#include "core/fitting/terrain/plane_grouping.h"
#include "core/fitting/terrain/relabel_planes.h"
#include "core/fitting/terrain/surface_kinds.h"
#include "core/fitting/terrain/surface_normals.h"
#include "core/fitting/terrain/terrain_shift.h"
#include "core/fitting/terrain/terrain_verdict.h"

namespace foresight {
namespace {

constexpr int kMinRays = 60;
constexpr double kMinArea_m2 = 0.01;
constexpr double kMinCover = 0.40;  // of a block that is offered
constexpr double kMaxSeeThrough = 0.30;
constexpr double kLargestPatch = 5.0;  // blocks; more is ground or a floor
constexpr double kMinLeftover = 0.15;  // of a block's area: a surface of its own

Status Cancelled() {
  return Fail(ErrorCode::kCancelled, "fitting the terrain was cancelled");
}

Status CheckRays(const RaySet& rays, const SurfaceGrid& grid) {
  FORESIGHT_CHECK(CheckRayNoise(rays));
  if (grid.size() < kMinRays)
    return Fail(ErrorCode::kTooFewPoints,
                "the region holds {} measurements, terrain needs {}: draw it larger, or scan "
                "slower",
                grid.size(), kMinRays);
  return {};
}

/// How far a return near an edge may lie from where the edge is.
double EdgeBlur(const RaySet& rays, const SurfaceGrid& grid, const Eigen::Vector3d& at) {
  const double range_m = (at - grid.viewpoint()).norm();
  return std::max(0.003, 0.25 * rays.footprint_rad * range_m);
}

/// A surface's frame: z its normal, x along the rectangle's first side or against it, whichever is
/// nearer to the right.
Rigid<frame::Base, frame::Object> PoseOf(const PlaneView& view, const BlockRectangle& rectangle) {
  const Eigen::Vector3d z = view.surface.plane.normal;
  Eigen::Vector3d x =
      view.InBase(rectangle.Flat(Eigen::Vector2d::UnitX())) - view.InBase(rectangle.center);
  x.normalize();
  if (x.x() < 0.0) x = -x;
  Eigen::Matrix3d rotation;
  rotation << x, z.cross(x), z;
  return {rotation, view.InBase(rectangle.center)};
}

TerrainSurface PlainSurface(const PlaneView& view, const BlockRectangle& bounds,
                            const Eigen::Vector3d& up) {
  BlockRectangle rectangle = bounds;
  if (rectangle.size_m.x() < rectangle.size_m.y()) {
    std::swap(rectangle.size_m.x(), rectangle.size_m.y());
    rectangle.yaw_rad += 1.5707963267948966;
  }
  TerrainSurface surface;
  surface.base_from_object = PoseOf(view, rectangle);
  surface.size_m = rectangle.size_m;
  surface.toehold.slope_rad = std::acos(std::clamp(view.surface.plane.normal.dot(up), -1.0, 1.0));
  surface.evidence.points = static_cast<int>(view.support.size());
  surface.evidence.rms_m = view.surface.rms_m;
  surface.verdict.reason = "not a block of the known size";
  return surface;
}

/// Everything found of one plane.
class SurfaceCollector {
 public:
  SurfaceCollector(const RaySet& rays, const SurfaceGrid& grid, const FitTerrainOptions& options)
      : rays_(rays), grid_(grid), options_(options) {
    size_m_ = {options.block_size_m.maxCoeff(), options.block_size_m.minCoeff()};
  }

  void Add(const SurfacePlanes& planes, int plane) {
    const PlaneView view = ViewOfPlane(grid_, planes, plane, 0.15);
    if (view.support.size() < 3) return;
    std::vector<PlaneView::Sample> left = view.support;
    if (view.surface.area_m2 < kLargestPatch * size_m_.prod()) AddBlocks(view, left);
    const bool whole = left.size() == view.support.size();
    double area = 0.0;
    for (const auto& sample : left) area += sample.area_m2;
    if (left.size() < 3 || (!whole && area < kMinLeftover * size_m_.prod())) return;
    PlaneView rest = view;
    rest.support = left;
    AddSurface(PlainSurface(rest, BoundsOfSupport(rest), options_.up), 0, left);
  }

  std::vector<TerrainSurface> surfaces;
  std::vector<RectangleEvidence> evidence;
  std::vector<std::vector<int>> points;  ///< of the grid, of each surface

 private:
  void AddBlocks(const PlaneView& view, std::vector<PlaneView::Sample>& left) {
    const double blur_m = EdgeBlur(rays_, grid_, view.surface.center);
    const double slope =
        std::acos(std::clamp(view.surface.plane.normal.dot(options_.up), -1.0, 1.0));
    if (slope > options_.max_tilt_rad) return;
    for (const BlockRectangle& rectangle : FitRectangles(view, size_m_, kMinCover, blur_m)) {
      const RectangleEvidence seen = GatherEvidence(grid_, view, rectangle);
      if (seen.block.cover < kMinCover || seen.block.see_through > kMaxSeeThrough) continue;
      TerrainSurface block = PlainSurface(view, rectangle, options_.up);
      block.kind = TerrainSurface::Kind::kBlock;
      block.evidence = seen.block;
      block.covariance = BlockCovariance(grid_, view, rectangle, seen, blur_m);
      block.toehold.size_m = (size_m_.array() - 2.0 * options_.toehold_margin_m).max(0.0).matrix();
      block.toehold.sigma_height_m = std::sqrt(block.covariance(2, 2));
      block.toehold.sigma_tilt_rad =
          std::sqrt(std::max(block.covariance(3, 3), block.covariance(4, 4)));
      std::vector<PlaneView::Sample> own;
      std::erase_if(left, [&](const auto& sample) {
        if (rectangle.Inside(sample.at) < -0.015) return false;
        own.push_back(sample);
        return true;
      });
      AddSurface(block, seen, own);
    }
  }

  void AddSurface(const TerrainSurface& surface, const RectangleEvidence& seen,
                  const std::vector<PlaneView::Sample>& own) {
    surfaces.push_back(surface);
    evidence.push_back(seen);
    points.emplace_back();
    for (const auto& sample : own) points.back().push_back(sample.point);
  }
  void AddSurface(const TerrainSurface& surface, int, const std::vector<PlaneView::Sample>& own) {
    AddSurface(surface, RectangleEvidence(), own);
  }

  const RaySet& rays_;
  const SurfaceGrid& grid_;
  const FitTerrainOptions& options_;
  Eigen::Vector2d size_m_;
};

/// Blocks first, nearest first.
std::vector<std::size_t> Order(const std::vector<TerrainSurface>& surfaces,
                               const Eigen::Vector3d& viewpoint) {
  std::vector<std::size_t> order(surfaces.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t i) {
    return std::pair(static_cast<int>(surfaces[i].kind),
                     (surfaces[i].base_from_object.translation() - viewpoint).norm());
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  return order;
}

TerrainDetection Detect(const RaySet& rays, const SurfaceGrid& grid,
                        const FitTerrainOptions& options, SurfaceCollector& found) {
  std::vector<int> drops;
  for (const RectangleEvidence& seen : found.evidence) drops.push_back(seen.dropping_edges);
  TellGround(options.up, drops, found.surfaces);
  MeasureSteps(options.up, found.surfaces);
  TerrainDetection detection;
  detection.labels.assign(rays.rays.size(), -1);
  for (const std::size_t i : Order(found.surfaces, grid.viewpoint())) {
    TerrainSurface& surface = found.surfaces[i];
    if (surface.kind == TerrainSurface::Kind::kBlock)
      surface.verdict = AssessBlock(rays, surface, found.evidence[i]);
    else
      surface.toehold.size_m.setZero();
    for (const int point : found.points[i])
      detection.labels[static_cast<std::size_t>(grid[point].ray)] =
          static_cast<int>(detection.surfaces.size());
    detection.surfaces.push_back(surface);
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
  SurfaceCollector found(rays, grid, options);
  for (int plane = 0; plane < static_cast<int>(planes.planes.size()); ++plane) {
    if (context.Cancelled()) return tl::unexpected(Cancelled().error());
    found.Add(planes, plane);
  }
  TerrainDetection detection = Detect(rays, grid, options, found);
  if (options.last) MarkShifts(*options.last, detection.surfaces);
  detection.origin.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  context.Report(1.0, "terrain fitted");
  return detection;
}

}  // namespace foresight
