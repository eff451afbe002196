#include "core/calibration/corner_grid.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace foresight {
namespace {

CornerGrid Transposed(const CornerGrid& grid) {
  CornerGrid result{grid.rows, grid.columns, grid.pixels};
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      result.At(row, column) = grid.At(column, row);
  return result;
}

CornerGrid MirroredInX(const CornerGrid& grid) {
  CornerGrid result = grid;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      result.At(column, row) = grid.At(grid.columns - 1 - column, row);
  return result;
}

/// Twice the area of the grid's outline, positive for x right and y down. The outline, not one
/// square: a square at the rim of a fisheye is thin.
double SignedArea(const CornerGrid& grid) {
  std::vector<Eigen::Vector2d> outline;
  for (int c = 0; c < grid.columns; ++c) outline.push_back(grid.At(c, 0));
  for (int r = 1; r < grid.rows; ++r) outline.push_back(grid.At(grid.columns - 1, r));
  for (int c = grid.columns - 2; c >= 0; --c) outline.push_back(grid.At(c, grid.rows - 1));
  for (int r = grid.rows - 2; r > 0; --r) outline.push_back(grid.At(0, r));
  double area = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d& a = outline[i];
    const Eigen::Vector2d& b = outline[(i + 1) % outline.size()];
    area += a.x() * b.y() - a.y() * b.x();
  }
  return area;
}

/// Three neighbouring places of a row of `count` and the weights of a parabola through them at
/// `place`.
struct Parabola {
  int first;
  std::array<double, 3> weights;
};

Parabola ParabolaAt(double place, int count) {
  const int first = std::clamp(static_cast<int>(std::lround(place)) - 1, 0, count - 3);
  const double t = place - first;
  return {first, {0.5 * (t - 1.0) * (t - 2.0), t * (2.0 - t), 0.5 * t * (t - 1.0)}};
}

}  // namespace

CornerGrid UpsideDown(const CornerGrid& grid) {
  CornerGrid result = grid;
  std::reverse(result.pixels.begin(), result.pixels.end());
  return result;
}

std::optional<CornerGrid> Arranged(const CornerGrid& grid, int columns, int rows) {
  CornerGrid result = grid;
  if (grid.columns != columns || grid.rows != rows) {
    if (grid.columns != rows || grid.rows != columns) return std::nullopt;
    result = Transposed(grid);
  }
  return SignedArea(result) < 0.0 ? MirroredInX(result) : result;
}

Eigen::Vector2d GridPoint(const CornerGrid& grid, double column, double row) {
  const Parabola across = ParabolaAt(column, grid.columns);
  const Parabola down = ParabolaAt(row, grid.rows);
  Eigen::Vector2d point = Eigen::Vector2d::Zero();
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      point += across.weights[static_cast<std::size_t>(c)] *
               down.weights[static_cast<std::size_t>(r)] *
               grid.At(across.first + c, down.first + r);
  return point;
}

SquareLevels MeasureLevels(const GrayImage& image, const CornerGrid& grid) {
  std::array<double, 2> sums{};
  std::array<int, 2> counts{};
  for (int row = 0; row + 1 < grid.rows; ++row)
    for (int column = 0; column + 1 < grid.columns; ++column) {
      const auto grey = GreyAt(image, GridPoint(grid, column + 0.5, row + 0.5));
      if (!grey) continue;
      // The square beyond corner (0, 0) has the colour of the one between it and (1, 1).
      const std::size_t which = (column + row) % 2 == 0 ? 0 : 1;
      sums[which] += *grey;
      ++counts[which];
    }
  SquareLevels levels;
  if (counts[0] > 0) levels.first = sums[0] / counts[0];
  if (counts[1] > 0) levels.second = sums[1] / counts[1];
  return levels;
}

std::optional<double> GreyAt(const GrayImage& image, const Eigen::Vector2d& pixel) {
  const double x = pixel.x(), y = pixel.y();
  if (!(x >= 0.0) || !(y >= 0.0) || !(x <= image.width() - 1.0) || !(y <= image.height() - 1.0))
    return std::nullopt;
  const int left = std::min(static_cast<int>(x), std::max(0, image.width() - 2));
  const int top = std::min(static_cast<int>(y), std::max(0, image.height() - 2));
  const int right = std::min(left + 1, image.width() - 1);
  const int bottom = std::min(top + 1, image.height() - 1);
  const double fx = x - left, fy = y - top;
  return (1.0 - fy) * ((1.0 - fx) * image(left, top) + fx * image(right, top)) +
         fy * ((1.0 - fx) * image(left, bottom) + fx * image(right, bottom));
}

}  // namespace foresight
