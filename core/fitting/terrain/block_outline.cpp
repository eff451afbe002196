#include "core/fitting/terrain/block_outline.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "core/base/squared.h"

namespace foresight {
namespace {

constexpr double kLeftOut_m = 0.020;  // at the corners, where other edges begin
constexpr int kChords = 6;            // of a line, which a lens bends
constexpr std::array<double, 4> kAcross = {-0.28, -0.12, 0.12, 0.28};  // of a side
constexpr std::array<double, 2> kSides = {-0.5, 0.5};

// What the nats of a rectangle's sides, each its mean, count beside what is known of its place, and
// how well a side that is seen tells it (docs/evaluation/terrain.md, "Blocks in the image").
constexpr double kSideNats = 12.0;
constexpr double kImageSigma_px = 0.9;
constexpr double kSeen_nats = 0.0;  // of a side: as much for an edge as against one
// A side that shows less moves no block: noise has as much.
constexpr double kNoise_nats = -0.8;
constexpr double kFurthest_m = 0.060, kFurthest_rad = 0.10;
constexpr std::array<double, 3> kSteps = {0.006, 0.003, 0.0015};  // m
constexpr double kLever_m = 0.2;  // at which a turn is a step as large

}  // namespace

LineInImage BlockOutline::Line(const BlockRectangle& rectangle, int axis, double at_m) const {
  const double reach_m = 0.5 * rectangle.size_m[1 - axis] - kLeftOut_m;
  std::vector<ImageEdges::Edge> chords;
  std::optional<Eigen::Vector2d> last;
  double length_px = 0.0;
  for (int i = 0; i <= kChords; ++i) {
    Eigen::Vector2d local;
    local[axis] = at_m;
    local[1 - axis] = reach_m * (2.0 * i / kChords - 1.0);
    const auto pixel = image_.PixelOf(view_.InBase(rectangle.Flat(local)));
    if (last && pixel) {
      chords.push_back({*last, *pixel});
      length_px += (*pixel - *last).norm();
    }
    last = pixel;
  }
  double nats = 0.0, shown_px = 0.0;
  for (const ImageEdges::Piece& piece : image_.PiecesAlong(chords, nullptr)) {
    nats += piece.length_px * ImageEdges::NatsOf(piece.response);
    shown_px += piece.length_px;
  }
  if (!(shown_px > 0.0)) return {};
  const double before_the_lens = static_cast<double>(chords.size()) / kChords;
  return {nats / shown_px, std::min(1.0, before_the_lens * shown_px / length_px)};
}

RectangleInImage BlockOutline::Outline(const BlockRectangle& rectangle) const {
  RectangleInImage outline;
  for (const int axis : {0, 1}) {
    LineInImage across;
    for (const double part : kAcross) {
      const LineInImage line = Line(rectangle, axis, part * rectangle.size_m[axis]);
      across.nats += line.shown * line.nats;
      across.shown += line.shown;
    }
    if (!(across.shown > 0.0)) continue;
    for (const double part : kSides) {
      const LineInImage side = Line(rectangle, axis, part * rectangle.size_m[axis]);
      outline.nats += 0.25 * side.shown * (side.nats - across.nats / across.shown);
      outline.shown += 0.25 * side.shown;
    }
  }
  return outline;
}

double BlockOutline::MetresPerPixel(const BlockRectangle& rectangle, int axis) const {
  constexpr double kApart_m = 0.05;
  const auto step = [&](int along) -> Eigen::Vector2d {
    Eigen::Vector2d half = Eigen::Vector2d::Zero();
    half[along] = 0.5 * kApart_m;
    const auto from = image_.PixelOf(view_.InBase(rectangle.Flat(-half)));
    const auto to = image_.PixelOf(view_.InBase(rectangle.Flat(half)));
    return from && to ? Eigen::Vector2d((*to - *from) / kApart_m) : Eigen::Vector2d::Zero();
  };
  const Eigen::Vector2d across = step(axis), side = step(1 - axis);
  const double area = std::abs(across.x() * side.y() - across.y() * side.x());
  return side.norm() / std::max(1e-6, area);
}

PlacedRectangle BlockOutline::Place(const PlacedRectangle& start) const {
  PlacedRectangle placed = start;
  placed.rectangle = MovedToSides(start);
  const Eigen::Matrix2d turned =
      Eigen::Rotation2Dd(start.rectangle.yaw_rad - placed.rectangle.yaw_rad).toRotationMatrix();
  placed.covariance = turned * start.covariance * turned.transpose();
  return WithSides(placed);
}

BlockRectangle BlockOutline::MovedToSides(const PlacedRectangle& start) const {
  const Eigen::Matrix2d information = start.covariance.inverse();
  const Eigen::Vector3d furthest(kFurthest_m, kFurthest_m, kFurthest_rad);
  const auto moved = [&](const Eigen::Vector3d& by) {
    BlockRectangle rectangle = start.rectangle;
    rectangle.center = rectangle.Flat(by.head<2>());
    rectangle.yaw_rad += by[2];
    return rectangle;
  };
  const auto score = [&](const Eigen::Vector3d& by) {
    const BlockRectangle rectangle = moved(by);
    double nats = -0.5 * by.head<2>().dot(information * by.head<2>()) -
                  0.5 * Squared(by[2] / start.yaw_sigma_rad);
    for (const int axis : {0, 1})
      for (const double part : kSides)
        nats += kSideNats *
                std::max(kNoise_nats,
                         Line(rectangle, axis, part * rectangle.size_m[axis]).NatsOr(kNoise_nats));
    return nats;
  };
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  double best_score = score(best);
  for (const double step_m : kSteps)
    for (const int axis : {0, 1, 2}) {
      const double step = axis < 2 ? step_m : step_m / kLever_m;
      const int count = step_m == kSteps.front() ? static_cast<int>(furthest[axis] / step) : 2;
      Eigen::Vector3d at = best;
      const double middle = best[axis];
      for (int k = -count; k <= count; ++k) {
        at[axis] = middle + k * step;
        if (k == 0 || std::abs(at[axis]) > furthest[axis]) continue;
        const double nats = score(at);
        if (nats > best_score) {
          best_score = nats;
          best = at;
        }
      }
    }
  return moved(best);
}

PlacedRectangle BlockOutline::WithSides(PlacedRectangle placed) const {
  Eigen::Matrix2d known = placed.covariance.inverse();
  double yaw_information = 1.0 / Squared(placed.yaw_sigma_rad);
  for (const int axis : {0, 1}) {
    int seen = 0;
    for (const double part : kSides) {
      const double at_m = part * placed.rectangle.size_m[axis];
      seen += Line(placed.rectangle, axis, at_m).NatsOr(kNoise_nats) > kSeen_nats ? 1 : 0;
    }
    if (seen == 0) continue;
    const double sigma_m = kImageSigma_px * MetresPerPixel(placed.rectangle, axis);
    // A rig that is off moves both sides alike.
    known(axis, axis) += 1.0 / Squared(sigma_m);
    const double length_m = placed.rectangle.size_m[1 - axis];
    yaw_information += seen * Squared(length_m) / 12.0 / Squared(sigma_m);
  }
  placed.covariance = known.inverse();
  placed.yaw_sigma_rad = 1.0 / std::sqrt(yaw_information);
  return placed;
}

}  // namespace foresight
