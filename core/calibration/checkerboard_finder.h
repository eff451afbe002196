#pragma once

#include <optional>

#include "core/calibration/corner_grid.h"

namespace foresight {

/// The inner corners of a checkerboard of columns x rows, refined below a pixel, seen whole and in
/// any rotation. Two detectors of OpenCV at several scales, then growth from a part that one of
/// them found: the squares of a fisheye image are curved and of very different sizes. What is found
/// is checked: black and white squares must alternate around every corner, and the board must end
/// beyond the outer corners. nullopt where there is no such board. Up to some seconds where there
/// is none.
std::optional<CornerGrid> FindCheckerboard(const GrayImage& image, int columns, int rows);

/// The largest checkerboard of at least 3 x 3 inner corners, of any size; for telling what is there
/// where the one that was asked for is not.
std::optional<CornerGrid> FindAnyCheckerboard(const GrayImage& image);

/// Whether black and white squares alternate around the corner at a place of the grid, or where the
/// grid would have one beyond its border; `contrast` as MeasureLevels has it.
bool IsCorner(const GrayImage& image, const CornerGrid& grid, int column, int row, double contrast);

}  // namespace foresight
