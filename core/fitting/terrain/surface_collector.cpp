#include "core/fitting/terrain/surface_collector.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/fitting/terrain/alike_sizes.h"
#include "core/fitting/terrain/block_lattice.h"
#include "core/fitting/terrain/block_outline.h"
#include "core/fitting/terrain/block_size.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

constexpr double kLeastOffered = 0.40;  // of a block that is offered
constexpr double kMaxSeeThrough = 0.30;
constexpr double kLargestPatch = 5.0;   // blocks; more is ground or a floor
constexpr double kMinLeftover = 0.15;   // of a block's area: a surface of its own
constexpr double kOwnMargin_m = 0.015;  // support this near to a block is its own
constexpr double kShown = 0.5;          // of a block's sides, of one that an image shows
constexpr int kMeasuredEdges = 2;       // of a block whose size was measured

bool Offered(const BlockEvidence& seen) {
  return seen.cover >= kLeastOffered && seen.see_through <= kMaxSeeThrough;
}

/// One holds a point of the other's sides, by more than blocks that touch do.
bool Overlap(const BlockRectangle& first, const BlockRectangle& second) {
  constexpr double kTouching_m = 0.015;
  const auto holds_side_of = [](const BlockRectangle& one, const BlockRectangle& other) {
    for (const double x : {-0.5, 0.0, 0.5})
      for (const double y : {-0.5, 0.0, 0.5})
        if (one.Inside(other.Flat(other.size_m.cwiseProduct(Eigen::Vector2d(x, y)))) > kTouching_m)
          return true;
    return false;
  };
  return holds_side_of(first, second) || holds_side_of(second, first);
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
    rectangle.yaw_rad += RadiansFromDegrees(90.0);
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

/// Two level directions.
Eigen::Matrix<double, 2, 3> LevelAxes(const Eigen::Vector3d& up) {
  Eigen::Matrix<double, 2, 3> axes;
  axes.row(0) = up.unitOrthogonal().transpose();
  axes.row(1) = up.cross(axes.row(0).transpose()).transpose();
  return axes;
}

/// From a block's own plane to its place seen from above.
Eigen::Matrix2d LevelFromFlat(const PlaneView& view, const Eigen::Matrix<double, 2, 3>& level) {
  Eigen::Matrix2d matrix;
  matrix << level * view.x, level * view.y;
  return matrix;
}

BlockPlace PlaceOf(const FoundSurface& block, const PlaneView& view,
                   const Eigen::Matrix<double, 2, 3>& level) {
  const auto& pose = block.surface.base_from_object;
  const Eigen::Matrix<double, 2, 3> level_from_object = level * pose.rotation().toRotationMatrix();
  const Eigen::Matrix2d sides = level_from_object.leftCols<2>();
  BlockPlace place;
  place.at = level * view.InBase(block.rectangle.center);
  place.covariance = sides * block.surface.covariance.topLeftCorner<2, 2>() * sides.transpose();
  place.yaw_rad = std::atan2(sides(1, 0), sides(0, 0));
  place.yaw_sigma_rad = std::sqrt(block.surface.covariance(5, 5));
  return place;
}

/// What a place from above says of a block's own pose.
void TakeCovariance(const BlockPlace& place, const Eigen::Matrix<double, 2, 3>& level,
                    TerrainSurface& block) {
  const Eigen::Matrix2d sides =
      (level * block.base_from_object.rotation().toRotationMatrix()).leftCols<2>();
  const Eigen::Matrix2d object_from_level = sides.inverse();
  block.covariance.topLeftCorner<2, 2>() =
      object_from_level * place.covariance * object_from_level.transpose();
  block.covariance(5, 5) = place.yaw_sigma_rad * place.yaw_sigma_rad;
}

/// The rectangle on its plane where a place from above wants it.
BlockRectangle MovedTo(const BlockPlace& to, const BlockPlace& from, const PlaneView& view,
                       const Eigen::Matrix<double, 2, 3>& level, BlockRectangle rectangle) {
  const Eigen::Matrix2d level_from_flat = LevelFromFlat(view, level);
  rectangle.center += level_from_flat.inverse() * (to.at - from.at);
  const double turn = to.yaw_rad - from.yaw_rad;
  rectangle.yaw_rad += level_from_flat.determinant() > 0.0 ? turn : -turn;
  return rectangle;
}

}  // namespace

SurfaceCollector::SurfaceCollector(const RaySet& rays, const SurfaceGrid& grid,
                                   const FitTerrainOptions& options)
    : rays_(rays), grid_(grid), options_(options) {
  size_m_ = {options.block_size_m.maxCoeff(), options.block_size_m.minCoeff()};
}

void SurfaceCollector::Add(const SurfacePlanes& planes, int plane) {
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
  FoundSurface plain;
  plain.surface = PlainSurface(rest, BoundsOfSupport(rest), options_.up);
  for (const auto& sample : left) plain.points.push_back(sample.point);
  found.push_back(std::move(plain));
}

void SurfaceCollector::AddBlocks(const PlaneView& view, std::vector<PlaneView::Sample>& left) {
  const double slope = std::acos(std::clamp(view.surface.plane.normal.dot(options_.up), -1.0, 1.0));
  if (slope > options_.max_tilt_rad) return;
  views_.push_back(view);
  const double blur_m = EdgeBlur(rays_, grid_, view.surface.center);
  for (const BlockRectangle& rectangle : FitRectangles(view, size_m_, kLeastOffered, blur_m)) {
    FoundSurface block = BlockAt(static_cast<int>(views_.size()) - 1, rectangle);
    if (!Offered(block.surface.evidence)) continue;
    std::erase_if(left, [&](const auto& sample) {
      if (rectangle.Inside(sample.at) < -kOwnMargin_m) return false;
      block.points.push_back(sample.point);
      return true;
    });
    found.push_back(std::move(block));
  }
}

FoundSurface SurfaceCollector::BlockAt(int view_index, const BlockRectangle& rectangle) const {
  const PlaneView& view = views_[static_cast<std::size_t>(view_index)];
  FoundSurface block;
  block.view = view_index;
  block.rectangle = rectangle;
  block.evidence = GatherEvidence(grid_, view, rectangle);
  TerrainSurface& surface = block.surface;
  surface = PlainSurface(view, rectangle, options_.up);
  surface.kind = TerrainSurface::Kind::kBlock;
  surface.evidence = block.evidence.block;
  surface.covariance = BlockCovariance(grid_, view, rectangle, block.evidence,
                                       EdgeBlur(rays_, grid_, view.surface.center));
  surface.toehold.size_m = (size_m_.array() - 2.0 * options_.toehold_margin_m).max(0.0).matrix();
  surface.toehold.sigma_height_m = std::sqrt(surface.covariance(2, 2));
  surface.toehold.sigma_tilt_rad =
      std::sqrt(std::max(surface.covariance(3, 3), surface.covariance(4, 4)));
  return block;
}

void SurfaceCollector::PlaceTogether() {
  const Eigen::Matrix<double, 2, 3> level = LevelAxes(options_.up);
  std::vector<std::size_t> blocks;
  std::vector<BlockPlace> places;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i].surface.kind != TerrainSurface::Kind::kBlock) continue;
    blocks.push_back(i);
    places.push_back(PlaceOf(found[i], views_[static_cast<std::size_t>(found[i].view)], level));
  }
  const auto lattice = FindBlockLattice(places, size_m_.mean());
  if (!lattice) return;
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    FoundSurface& block = found[blocks[k]];
    const LatticePlace& settled = lattice->places[k];
    if (settled.in_rows) {
      const PlaneView& view = views_[static_cast<std::size_t>(block.view)];
      MoveTo(MovedTo(settled.place, places[k], view, level, block.rectangle), block);
      TakeCovariance(settled.place, level, block.surface);
    }
    block.evidence.row =
        settled.in_rows ? RectangleEvidence::Row::kIn : RectangleEvidence::Row::kOut;
    block.evidence.row_gap_sigmas = settled.gap_sigmas;
  }
}

void SurfaceCollector::MoveTo(const BlockRectangle& rectangle, FoundSurface& block) const {
  FoundSurface moved = BlockAt(block.view, rectangle);
  moved.points = std::move(block.points);
  moved.evidence.row = block.evidence.row;
  moved.evidence.row_gap_sigmas = block.evidence.row_gap_sigmas;
  block = std::move(moved);
}

void SurfaceCollector::PlaceByImage() {
  if (rays_.image == nullptr) return;
  for (FoundSurface& block : found) {
    if (block.surface.kind != TerrainSurface::Kind::kBlock) continue;
    const PoseCovariance& covariance = block.surface.covariance;
    const PlacedRectangle placed =
        BlockOutline(*rays_.image, views_[static_cast<std::size_t>(block.view)])
            .Place(
                {block.rectangle, covariance.topLeftCorner<2, 2>(), std::sqrt(covariance(5, 5))});
    FoundSurface moved = block;
    MoveTo(placed.rectangle, moved);
    if (!Offered(moved.surface.evidence) || MovedIntoAnother(block, moved)) continue;
    block = std::move(moved);
    block.surface.covariance.topLeftCorner<2, 2>() = placed.covariance;
    block.surface.covariance(5, 5) = placed.yaw_sigma_rad * placed.yaw_sigma_rad;
  }
}

bool SurfaceCollector::MovedIntoAnother(const FoundSurface& block,
                                        const FoundSurface& moved) const {
  return std::any_of(found.begin(), found.end(), [&](const FoundSurface& other) {
    return &other != &block && other.view == block.view &&
           other.surface.kind == TerrainSurface::Kind::kBlock &&
           Overlap(moved.rectangle, other.rectangle) && !Overlap(block.rectangle, other.rectangle);
  });
}

void SurfaceCollector::MeasureSizes() {
  std::vector<FoundSurface*> blocks;
  for (FoundSurface& surface : found)
    if (surface.surface.kind == TerrainSurface::Kind::kBlock) blocks.push_back(&surface);
  std::vector<double> own_nats;
  for (FoundSurface* block : blocks) {
    std::vector<BlockRectangle> others;
    for (const FoundSurface* other : blocks)
      if (other != block && other->view == block->view) others.push_back(other->rectangle);
    BlockEvidence& evidence = block->surface.evidence;
    const PlaneView& view = views_[static_cast<std::size_t>(block->view)];
    std::optional<BlockOutline> outline;
    if (rays_.image != nullptr) outline.emplace(*rays_.image, view);
    const RectangleInImage seen = outline ? outline->Outline(block->rectangle) : RectangleInImage();
    block->evidence.in_image = seen.shown >= kShown;
    evidence.outline_nats = block->evidence.in_image ? seen.nats : 0.0;
    evidence.size_margin =
        SizeMargin(view, block->rectangle, others, block->evidence.in_image ? &*outline : nullptr);
    own_nats.push_back(
        evidence.confirmed_edges < kMeasuredEdges
            ? std::nan("")
            : NatsOfSize(evidence.size_margin, rays_.dense, block->evidence.in_image));
  }
  const std::vector<double> nats = NatsAmongOthers(own_nats);
  for (std::size_t i = 0; i < blocks.size(); ++i) blocks[i]->surface.evidence.size_nats = nats[i];
}

}  // namespace foresight
