#pragma once

#include <optional>

#include "core/calibration/corner_grid.h"

namespace foresight {

/// What a search for a checkerboard found.
struct CheckerboardSearch {
  std::optional<CornerGrid> grid;  ///< the board that was asked for, whole
  /// Where it was not found: the largest other grid, of at least 3 x 3 inner corners, and whether
  /// that is a whole board or goes on where it cannot be seen.
  std::optional<CornerGrid> other;
  bool other_is_whole = false;
};

/// How much time a search may take where there is no board.
enum class SearchEffort {
  kThorough,  ///< some seconds; says what is there instead
  kQuick,     ///< tenths of a second: for many images of which most show the board, or none
  kLive,      ///< as kQuick, and says what is there instead: for small images that go by
};

/// The inner corners of a checkerboard of columns x rows, refined below a pixel, in any rotation.
/// Two detectors of OpenCV at several scales, then growth from a part that one of them found: the
/// squares of a fisheye image are curved and of very different sizes. What is found is checked:
/// black and white squares must alternate around the corners, and the board must end beyond the
/// outer ones. Up to some seconds where there is no board.
CheckerboardSearch FindCheckerboard(const GrayImage& image, int columns, int rows,
                                    SearchEffort effort = SearchEffort::kThorough);

/// Whether black and white squares alternate around the corner at a place of the grid, or where the
/// grid would have one beyond its border; `contrast` as MeasureLevels has it.
bool IsCorner(const GrayImage& image, const CornerGrid& grid, int column, int row, double contrast);

}  // namespace foresight
