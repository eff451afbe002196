#pragma once

#include <vector>

#include "core/calibration/corner_grid.h"

namespace foresight {

/// Fraction of the corners that must pass. Glare and shadows hide some.
inline constexpr double kCornersThatPass = 0.9;

/// Of a square, from its corner: clear of edges, blurred ones too.
inline constexpr double kReach = 0.4;
/// Within the white margin around a board's squares.
inline constexpr double kNearReach = 0.2;

/// Whether black and white squares alternate around the corner at a place of the grid, or where the
/// grid would have one beyond its border; `contrast` as MeasureLevels has it.
bool IsCorner(const GrayImage& image, const CornerGrid& grid, int column, int row, double contrast,
              double reach = kReach);
/// Whether the squares around a corner are in the image.
bool SquaresAreSeen(const GrayImage& image, const CornerGrid& grid, int column, int row);

/// Numbers of the corners that something else than squares is beside, such as what covers one: they
/// may be off. In increasing order.
std::vector<int> UncertainCorners(const GrayImage& image, const CornerGrid& grid);

/// Whether squares alternate all over the grid, and edges between squares join each of its rows to
/// the next and each column to the next: there is none across the gap between two boards.
bool IsRegular(const GrayImage& image, const CornerGrid& grid);

}  // namespace foresight
