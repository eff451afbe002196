#include "core/simulation/board_face.h"

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "core/objects/marker_cells.h"

namespace foresight {
namespace {

/// Corners that jitter by more may exchange their places.
constexpr double kMostJitter = 0.05;  // of a square
constexpr double kMostWarp_m = 0.05;

}  // namespace

Status PrintErrors::Check(const CalibrationBoard& board) const {
  if (!(scale.minCoeff() >= 0.8) || !(scale.maxCoeff() <= 1.25))
    return Fail(ErrorCode::kInvalidOptions, "scale: ({}, {}) is not within 0.8 to 1.25", scale.x(),
                scale.y());
  if (!(corner_jitter_m >= 0.0) || !(corner_jitter_m <= kMostJitter * board.square_m))
    return Fail(ErrorCode::kInvalidOptions,
                "corner_jitter_m: {} is not within 0 to {}, 1/20 of a "
                "square",
                corner_jitter_m, kMostJitter * board.square_m);
  if (!(std::max(std::abs(warp.x_m), std::abs(warp.y_m)) <= kMostWarp_m))
    return Fail(ErrorCode::kInvalidOptions, "warp: ({}, {}) m is more than {} m", warp.x_m,
                warp.y_m, kMostWarp_m);
  return {};
}

BoardFace::BoardFace(const CalibrationBoard& board, const PrintErrors& errors)
    : board_(board),
      errors_(errors),
      per_scale_(errors.scale.cwiseInverse().cast<float>()),
      per_square_(static_cast<float>(1.0 / board.square_m)) {
  Random random(errors.seed);
  for (int id = 0; id < board.CornerCount(); ++id) {
    const double x = random.Normal(), y = random.Normal();
    jitter_m_.emplace_back(errors.corner_jitter_m * Eigen::Vector2d(x, y));
  }
  for (int marker = 0; marker < board.MarkerCount(); ++marker)
    markers_.push_back(MarkerCells(board.dictionary, marker, &marker_cells_));
}

Eigen::Vector3d BoardFace::Corner(int id) const {
  const Eigen::Vector3d drawn = board_.Corner(id);
  const Eigen::Vector2d at =
      (drawn.head<2>() + jitter_m_[static_cast<std::size_t>(id)]).cwiseProduct(errors_.scale);
  return {at.x(), at.y(), Depth(at)};
}

double BoardFace::Depth(const Eigen::Vector2d& at) const {
  // The parabola of CalibrationBoard::Corner, which goes on beyond the corners.
  const double x =
      2.0 * at.x() / (errors_.scale.x() * (board_.columns - 1) * board_.square_m) - 1.0;
  const double y = 2.0 * at.y() / (errors_.scale.y() * (board_.rows - 1) * board_.square_m) - 1.0;
  return errors_.warp.x_m * (1.0 - x * x) + errors_.warp.y_m * (1.0 - y * y);
}

std::array<Eigen::Vector2d, 4> BoardFace::Outline() const {
  std::array<Eigen::Vector2d, 4> outline;
  const std::array<Eigen::Vector3d, 4> drawn = board_.Outline();
  for (std::size_t i = 0; i < outline.size(); ++i)
    outline[i] = drawn[i].head<2>().cwiseProduct(errors_.scale);
  return outline;
}

/// Between the corners bilinear, beyond them as on the nearest.
Eigen::Vector2f BoardFace::Jitter(const Eigen::Vector2f& drawn) const {
  const float x = std::clamp(drawn.x() * per_square_, 0.0f, static_cast<float>(board_.columns - 1));
  const float y = std::clamp(drawn.y() * per_square_, 0.0f, static_cast<float>(board_.rows - 1));
  const int column = std::min(static_cast<int>(x), board_.columns - 2);
  const int row = std::min(static_cast<int>(y), board_.rows - 2);
  const float u = x - static_cast<float>(column), v = y - static_cast<float>(row);
  const auto at = [&](int right, int down) -> Eigen::Vector2f {
    return jitter_m_[static_cast<std::size_t>((row + down) * board_.columns + column + right)]
        .cast<float>();
  };
  return (1.0f - v) * ((1.0f - u) * at(0, 0) + u * at(1, 0)) +
         v * ((1.0f - u) * at(0, 1) + u * at(1, 1));
}

bool BoardFace::WhiteAt(const Eigen::Vector2f& at) const {
  Eigen::Vector2f drawn = at.cwiseProduct(per_scale_);
  if (errors_.corner_jitter_m > 0.0) {
    // The jitter is a hundredth of a square: the second step leaves a millionth of one.
    const Eigen::Vector2f near = drawn - Jitter(drawn);
    drawn -= Jitter(near);
  }
  const float x = drawn.x() * per_square_ + 1.0f, y = drawn.y() * per_square_ + 1.0f;
  const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
  if (column < 0 || row < 0 || column > board_.columns || row > board_.rows) return true;
  if (CalibrationBoard::IsBlack(column, row)) return false;
  const int marker = board_.MarkerAt(column, row);
  if (marker < 0) return true;
  const auto side = static_cast<float>(board_.marker_per_square);
  const auto cell_of = [&](float place) {
    return static_cast<int>(
        std::floor((place - 0.5f * (1.0f - side)) / side * static_cast<float>(marker_cells_)));
  };
  const int right = cell_of(x - static_cast<float>(column));
  const int down = cell_of(y - static_cast<float>(row));
  if (right < 0 || down < 0 || right >= marker_cells_ || down >= marker_cells_) return true;
  return markers_[static_cast<std::size_t>(marker)]
                 [static_cast<std::size_t>(down * marker_cells_ + right)];
}

float BoardFace::WhiteIn(const std::array<Eigen::Vector2f, 4>& quadrilateral) const {
  constexpr int kSide = 4;  // samples a side
  const auto& [a, b, c, d] = quadrilateral;
  const bool white = WhiteAt(a);
  // Where all corners show the same nothing is inside but what is as small.
  if (WhiteAt(b) == white && WhiteAt(c) == white && WhiteAt(d) == white) return white ? 1.0f : 0.0f;
  int count = 0;
  for (int i = 0; i < kSide * kSide; ++i) {
    const float u = (static_cast<float>(i % kSide) + 0.5f) / kSide;
    const float v = (static_cast<float>(i / kSide) + 0.5f) / kSide;
    count += WhiteAt((1.0f - v) * ((1.0f - u) * a + u * b) + v * ((1.0f - u) * d + u * c)) ? 1 : 0;
  }
  return static_cast<float>(count) / (kSide * kSide);
}

}  // namespace foresight
