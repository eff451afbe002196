#include "core/fitting/terrain/block_rectangle.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/base/quantile.h"
#include "core/fitting/terrain/range_plane.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

// Of what rises beside a top only the foot says where the top ends: blocks lean over it higher up,
// and a whole face falls on one line of the plane.
constexpr double kOccupied_m = 0.050;

// A beam counts as gone past an edge as soon as a part of its footprint reads what lies behind: its
// middle is then this fraction of the footprint's length inside the edge.
constexpr double kPastEdge = 0.20;

constexpr double kOneBlock = 1.25;       // a patch of more area may hold several
constexpr int kMaxBlocks = 8;            // of a patch
constexpr double kPeelMargin_m = 0.015;  // support this near to a peeled block goes with it
constexpr int kCoarseSamples = 600;

/// What a score needs of a view: signed areas in the plane.
struct Piece {
  Eigen::Vector2d at;
  double inside = 0.0;  ///< gain of an area inside
  double around = 0.0;  ///< gain of an area in the band around
};

/// What is `taken` by other blocks is as if rays had gone through.
std::vector<Piece> PiecesOf(const PlaneView& view, const std::vector<PlaneView::Sample>& support,
                            const std::vector<PlaneView::Sample>& taken) {
  std::vector<Piece> pieces;
  pieces.reserve(view.support.size() + view.through.size() + view.occupied.size());
  for (const auto& sample : support)
    pieces.push_back({sample.at, sample.area_m2, -kOutsideWeight * sample.area_m2});
  for (const auto* closed : {&view.through, &view.occupied, &taken})
    for (const auto& sample : *closed) pieces.push_back({sample.at, -sample.area_m2, 0.0});
  return pieces;
}

std::vector<Piece> Coarse(const std::vector<Piece>& pieces) {
  const std::size_t skip = 1 + pieces.size() / kCoarseSamples;
  std::vector<Piece> coarse;
  for (std::size_t i = 0; i < pieces.size(); i += skip) {
    coarse.push_back(pieces[i]);
    coarse.back().inside *= static_cast<double>(skip);
    coarse.back().around *= static_cast<double>(skip);
  }
  return coarse;
}

double Score(const std::vector<Piece>& pieces, const BlockRectangle& rectangle, double softness_m) {
  const double c = std::cos(rectangle.yaw_rad), s = std::sin(rectangle.yaw_rad);
  const Eigen::Vector2d half = 0.5 * rectangle.size_m;
  double score = 0.0;
  for (const Piece& piece : pieces) {
    const double dx = piece.at.x() - rectangle.center.x();
    const double dy = piece.at.y() - rectangle.center.y();
    const double inside =
        std::min(half.x() - std::abs(c * dx + s * dy), half.y() - std::abs(c * dy - s * dx));
    if (inside < -kRectangleBand_m) continue;
    const double fraction = std::clamp(0.5 + 0.5 * inside / softness_m, 0.0, 1.0);
    score += fraction * piece.inside + (1.0 - fraction) * piece.around;
  }
  return score;
}

/// Pattern search over place and yaw, steps halved `rounds` times.
void Climb(const std::vector<Piece>& pieces, double softness_m, double step_m, double step_rad,
           int rounds, BlockRectangle& best) {
  best.score_m2 = Score(pieces, best, softness_m);
  for (int round = 0; round < rounds; ++round, step_m *= 0.5, step_rad *= 0.5) {
    for (int pass = 0; pass < 4; ++pass) {
      bool better = false;
      for (int way = 0; way < 6; ++way) {
        BlockRectangle moved = best;
        const double sign = way % 2 == 0 ? 1.0 : -1.0;
        if (way / 2 == 2)
          moved.yaw_rad += sign * step_rad;
        else
          moved.center = best.Flat(sign * step_m * Eigen::Vector2d::Unit(way / 2));
        moved.score_m2 = Score(pieces, moved, softness_m);
        if (!(moved.score_m2 > best.score_m2)) continue;
        best = moved;
        better = true;
      }
      if (!better) break;
    }
  }
}

BlockRectangle BoundsOf(const std::vector<PlaneView::Sample>& support) {
  BlockRectangle best;
  if (support.empty()) return best;
  constexpr int kTurns = 45;
  double least = 1e9;
  const std::size_t cut = support.size() / 100;
  std::vector<double> along(support.size()), across(support.size());
  for (int turn = 0; turn < kTurns; ++turn) {
    const double yaw = 0.5 * std::numbers::pi * turn / kTurns;
    const double c = std::cos(yaw), s = std::sin(yaw);
    for (std::size_t i = 0; i < support.size(); ++i) {
      along[i] = c * support[i].at.x() + s * support[i].at.y();
      across[i] = c * support[i].at.y() - s * support[i].at.x();
    }
    const auto bounds = [cut](std::vector<double>& values) -> Eigen::Vector2d {
      const double low = MoveToRank(values, cut);
      return {low, MoveToRank(values, values.size() - 1 - cut)};
    };
    const Eigen::Vector2d u = bounds(along), v = bounds(across);
    const Eigen::Vector2d size(u[1] - u[0], v[1] - v[0]);
    if (!(size.prod() < least)) continue;
    least = size.prod();
    const double mid_u = 0.5 * u.sum(), mid_v = 0.5 * v.sum();
    best = {{c * mid_u - s * mid_v, s * mid_u + c * mid_v}, yaw, size, 0.0};
  }
  return best;
}

/// Where a search starts: the middle of the support, the corners of its bounds when there is room
/// for more than one block, each also turned by a right angle when the sides differ.
std::vector<BlockRectangle> Starts(const std::vector<PlaneView::Sample>& support, double area_m2,
                                   const Eigen::Vector2d& size_m) {
  const BlockRectangle bounds = BoundsOf(support);
  std::vector<BlockRectangle> starts;
  for (const double turn : {0.0, 0.5 * std::numbers::pi}) {
    BlockRectangle start{bounds.center, bounds.yaw_rad + turn, size_m, 0.0};
    starts.push_back(start);
    start.yaw_rad += 0.25 * std::numbers::pi;
    starts.push_back(start);
    if (area_m2 < kOneBlock * size_m.prod()) continue;
    const Eigen::Vector2d room =
        turn == 0.0 ? bounds.size_m : Eigen::Vector2d(bounds.size_m.y(), bounds.size_m.x());
    for (const double sx : {-1.0, 1.0})
      for (const double sy : {-1.0, 1.0}) {
        BlockRectangle corner{bounds.center, bounds.yaw_rad + turn, size_m, 0.0};
        corner.center =
            corner.Flat(0.5 * Eigen::Vector2d(sx, sy).cwiseProduct((room - size_m).cwiseMax(0.0)));
        starts.push_back(corner);
      }
  }
  return starts;
}

/// How surely a point that belongs to no plane is not of this one: from 0 at a deviation to 1 at
/// two.
double CertainlyOff(double distance_sigmas) {
  return std::clamp(std::abs(distance_sigmas) - 1.0, 0.0, 1.0);
}

double AreaOf(const std::vector<PlaneView::Sample>& samples) {
  double area = 0.0;
  for (const auto& sample : samples) area += sample.area_m2;
  return area;
}

BlockRectangle BestRectangle(const PlaneView& view, const std::vector<PlaneView::Sample>& support,
                             const std::vector<PlaneView::Sample>& taken,
                             const Eigen::Vector2d& size_m, double softness_m) {
  const std::vector<Piece> pieces = PiecesOf(view, support, taken);
  const std::vector<Piece> coarse = Coarse(pieces);
  BlockRectangle best;
  best.score_m2 = -1e9;
  for (BlockRectangle start : Starts(support, AreaOf(support), size_m)) {
    Climb(coarse, 2.0 * softness_m, 0.040, RadiansFromDegrees(8.0), 3, start);
    if (start.score_m2 > best.score_m2) best = start;
  }
  Climb(pieces, softness_m, 0.008, RadiansFromDegrees(2.0), 5, best);
  return best;
}

/// From the middle of a beam's footprint on the plane to the part of it that went past an edge.
Eigen::Vector2d FootprintShift(const SurfaceGrid& grid, int i, const PlaneView& view) {
  const GridPoint& point = grid[i];
  const Eigen::Vector2d away(view.x.dot(point.direction), view.y.dot(point.direction));
  const double footprint_m =
      LengthOn(view.surface.plane, point.direction, point.range_m, grid.footprint_height_rad());
  return kPastEdge * footprint_m * away.normalized();
}

}  // namespace

Eigen::Vector2d BlockRectangle::Local(const Eigen::Vector2d& at) const {
  return Eigen::Rotation2Dd(-yaw_rad) * (at - center);
}

Eigen::Vector2d BlockRectangle::Flat(const Eigen::Vector2d& local) const {
  return center + Eigen::Rotation2Dd(yaw_rad) * local;
}

double BlockRectangle::Inside(const Eigen::Vector2d& at) const {
  return (0.5 * size_m - Local(at).cwiseAbs()).minCoeff();
}

PlaneView ViewOfPlane(const SurfaceGrid& grid, const SurfacePlanes& surfaces, int plane,
                      double margin_m) {
  PlaneView view;
  view.surface = surfaces.planes[static_cast<std::size_t>(plane)];
  const Plane& surface = view.surface.plane;
  view.x = surface.normal.unitOrthogonal();
  view.y = surface.normal.cross(view.x);
  Eigen::AlignedBox2d bounds;
  for (int i = 0; i < grid.size(); ++i) {
    if (surfaces.labels[static_cast<std::size_t>(i)] != plane) continue;
    const double range_m = RangeTo(surface, grid[i].origin, grid[i].direction);
    if (!std::isfinite(range_m)) continue;
    const Eigen::Vector2d at = view.Flat(grid[i].origin + range_m * grid[i].direction);
    view.support.push_back({at, AreaOn(surface, grid[i], range_m), i});
    bounds.extend(at);
  }
  if (view.support.empty()) return view;
  bounds.min().array() -= margin_m;
  bounds.max().array() += margin_m;
  for (int i = 0; i < grid.size(); ++i) {
    const int label = surfaces.labels[static_cast<std::size_t>(i)];
    if (label == plane) continue;
    const double above = surface.Distance(grid[i].point);
    const double certainty =
        label >= 0 ? 1.0 : CertainlyOff(above / DistanceSigma(grid, i, surface));
    if (above < 0.0) {
      const double range_m = RangeTo(surface, grid[i].origin, grid[i].direction);
      if (!std::isfinite(range_m)) continue;
      const Eigen::Vector2d at =
          view.Flat(grid[i].origin + range_m * grid[i].direction) + FootprintShift(grid, i, view);
      if (bounds.contains(at))
        view.through.push_back({at, certainty * AreaOn(surface, grid[i], range_m), i});
    } else if (above < kOccupied_m) {
      const Eigen::Vector2d at = view.Flat(grid[i].point);
      if (bounds.contains(at))
        view.occupied.push_back({at, certainty * AreaOn(surface, grid[i], grid[i].range_m), i});
    }
  }
  return view;
}

BlockRectangle BoundsOfSupport(const PlaneView& view) {
  return BoundsOf(view.support);
}

std::vector<BlockRectangle> FitRectangles(const PlaneView& view, const Eigen::Vector2d& size_m,
                                          double min_cover, double softness_m) {
  std::vector<BlockRectangle> rectangles;
  std::vector<PlaneView::Sample> left = view.support, taken;
  while (static_cast<int>(rectangles.size()) < kMaxBlocks &&
         AreaOf(left) > min_cover * size_m.prod()) {
    const BlockRectangle best = BestRectangle(view, left, taken, size_m, softness_m);
    const double before = AreaOf(left);
    std::erase_if(left, [&](const auto& sample) {
      if (best.Inside(sample.at) < -kPeelMargin_m) return false;
      taken.push_back(sample);
      return true;
    });
    if (before - AreaOf(left) < min_cover * size_m.prod()) break;
    rectangles.push_back(best);
  }
  return rectangles;
}

}  // namespace foresight
