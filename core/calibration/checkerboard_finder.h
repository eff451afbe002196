#pragma once

#include <optional>
#include <vector>

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
  kThorough,  ///< up to some seconds: for blurred, noisy and very curved boards too
  kQuick,     ///< hundredths of a second: for many images of which some show no board
};

/// All checkerboards of an image, of whatever size, as far as they are seen: refined below a pixel,
/// 3 x 3 inner corners at least, black and white squares alternate around them. Hundredths of a
/// second.
std::vector<CornerGrid> FindGrids(const GrayImage& image);

/// The inner corners of a checkerboard of columns x rows, refined below a pixel, in any rotation:
/// one of the image's `grids`; with kThorough, two detectors of OpenCV are asked at several scales
/// where none fits, as the squares of a fisheye image are curved and of very different sizes. What
/// is found is checked: black and white squares must alternate around the corners, edges must join
/// them, and the board must end beyond the outer ones.
CheckerboardSearch FindCheckerboard(const GrayImage& image, const std::vector<CornerGrid>& grids,
                                    int columns, int rows, SearchEffort effort);

}  // namespace foresight
