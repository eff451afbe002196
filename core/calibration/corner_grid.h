#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/base/image.h"

namespace foresight {

/// Inner corners of a checkerboard in an image, row by row. Rows follow each other clockwise from
/// columns: x to the right and y down, turned but never mirrored.
struct CornerGrid {
  int columns = 0;
  int rows = 0;
  std::vector<Eigen::Vector2d> pixels;

  Eigen::Vector2d& At(int column, int row) {
    return pixels[static_cast<std::size_t>(row * columns + column)];
  }
  const Eigen::Vector2d& At(int column, int row) const {
    return pixels[static_cast<std::size_t>(row * columns + column)];
  }
};

/// The grid with its first corner where its last one was.
CornerGrid UpsideDown(const CornerGrid& grid);
/// The same corners with columns for rows, so that `columns` and `rows` are as wanted; mirrored
/// grids are mended. nullopt where the counts do not fit either way.
std::optional<CornerGrid> Arranged(const CornerGrid& grid, int columns, int rows);

/// The pixel where a grid, continued by a quadratic curve, has a corner outside of itself: column
/// or row may be -2 to count + 1. Fractions are allowed: (-0.5, 0.5) is the middle of a square.
Eigen::Vector2d GridPoint(const CornerGrid& grid, double column, double row);

/// Mean grey levels of the squares between and around the inner corners.
struct SquareLevels {
  double first = 0.0;   ///< squares of the colour of the print's first one, beyond corner (0, 0)
  double second = 0.0;  ///< the other squares
  double Contrast() const { return second - first; }
};
SquareLevels MeasureLevels(const GrayImage& image, const CornerGrid& grid);

/// The grey value between pixels; nullopt outside of the image.
std::optional<double> GreyAt(const GrayImage& image, const Eigen::Vector2d& pixel);

}  // namespace foresight
