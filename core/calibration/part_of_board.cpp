#include "core/calibration/part_of_board.h"

#include <algorithm>

namespace foresight {
namespace {

bool Contains(const CalibrationBoard& large, const CalibrationBoard& small) {
  const auto [short_side, long_side] = std::minmax(small.columns, small.rows);
  const auto [low, high] = std::minmax(large.columns, large.rows);
  return short_side <= low && long_side <= high;
}

}  // namespace

bool MayBePartOf(const CalibrationBoard& board, const BoardView& view,
                 const CalibrationBoard& other, int width, int height) {
  using Kind = CalibrationBoard::Kind;
  if (board.kind != Kind::kCheckerboard || other.kind != Kind::kCheckerboard) return false;
  if (!Contains(other, board)) return false;
  std::vector<Eigen::Vector2d> pixels(view.pixels.size());
  for (std::size_t i = 0; i < view.corner_ids.size(); ++i)
    pixels[static_cast<std::size_t>(view.corner_ids[i])] = view.pixels[i];
  const auto at = [&](int column, int row) -> const Eigen::Vector2d& {
    return pixels[static_cast<std::size_t>(row * board.columns + column)];
  };
  const auto cut = [&](const Eigen::Vector2d& outer, const Eigen::Vector2d& inner) {
    const Eigen::Vector2d beyond = 2.0 * outer - inner;  // where a further corner would be
    return beyond.x() < 0.0 || beyond.y() < 0.0 || beyond.x() > width - 1.0 ||
           beyond.y() > height - 1.0;
  };
  const int right = board.columns - 1, bottom = board.rows - 1;
  for (int row = 0; row <= bottom; ++row)
    if (cut(at(0, row), at(1, row)) || cut(at(right, row), at(right - 1, row))) return true;
  for (int column = 0; column <= right; ++column)
    if (cut(at(column, 0), at(column, 1)) || cut(at(column, bottom), at(column, bottom - 1)))
      return true;
  return false;
}

}  // namespace foresight
