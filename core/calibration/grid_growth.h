#pragma once

#include "core/calibration/corner_grid.h"

namespace foresight {

/// Whether a board goes on beyond none of the grid's sides; what lies outside of the image is not
/// known, and counts as an end or not.
enum class OutsideImage { kIsAnEnd, kIsNoEnd };
bool Ends(const GrayImage& image, const CornerGrid& grid, OutsideImage outside);

/// Whether a white margin is seen on all sides: the outer squares are whole, and paper as white as
/// the squares is beyond them.
bool HasMargin(const GrayImage& image, const CornerGrid& grid);

/// What is left of a grid without the outer rows and columns in which too few squares alternate, as
/// where something covers them: regular, or with less than 3 rows or columns, or as it was inside.
CornerGrid Trimmed(const GrayImage& image, CornerGrid grid);

/// The grid with all further rows and columns whose corners are in the image.
CornerGrid Grown(const GrayImage& image, CornerGrid grid);

}  // namespace foresight
