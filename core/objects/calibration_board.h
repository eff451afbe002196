#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace foresight {

/// How a board that should be flat is bent: a parabola a direction, as mrcal has it. The middle of
/// the grid of inner corners lies deeper (towards +z) than the grid's ends.
struct BoardWarp {
  double x_m = 0.0;  ///< depth of the middle below the left and right ends
  double y_m = 0.0;  ///< depth of the middle below the upper and lower ends

  bool operator==(const BoardWarp&) const = default;
};

/// A printed board of black and white squares whose inner corners are known. In frame::Pattern:
/// corner 0 is the origin, x runs along its row, y along its column, and z points into the board,
/// away from who looks at it, so that x is right, y is down and z is forward for a board seen
/// upright, as in the camera's frame. The print is one square larger all round than the grid of
/// inner corners; its first square (beside corner 0, beyond the grid) is black.
///
/// A ChArUco board has a marker in each white square, numbered from 0, row by row.
struct CalibrationBoard {
  enum class Kind { kCheckerboard, kCharuco };
  /// Sets of markers of OpenCV (cv::aruco): bits a side, and how many markers there are.
  enum class Dictionary {
    k4x4_50,
    k4x4_100,
    k4x4_250,
    k5x5_50,
    k5x5_100,
    k5x5_250,
    k6x6_50,
    k6x6_100,
    k6x6_250
  };

  Kind kind = Kind::kCheckerboard;
  int columns = 8;  ///< inner corners in a row, 3 to 60
  int rows = 6;     ///< inner corners in a column, 3 to 60
  double square_m = 0.050;
  double marker_per_square = 0.75;               ///< side of a marker, of a ChArUco board only
  Dictionary dictionary = Dictionary::k5x5_250;  ///< of a ChArUco board only

  Status Check() const;

  int CornerCount() const { return columns * rows; }
  /// Row by row: corner `id` is in column id % columns of row id / columns. @pre a corner's id
  Eigen::Vector3d Corner(int id) const { return Corner(id, BoardWarp{}); }
  Eigen::Vector3d Corner(int id, const BoardWarp& warp) const;
  /// z of the corner by warp.x_m and by warp.y_m.
  Eigen::Vector2d CornerByWarp(int id) const;

  /// The corners of the printed squares' outline: first square's, then clockwise as one looks at
  /// it.
  std::array<Eigen::Vector3d, 4> Outline() const;
  double Width() const { return (columns + 1) * square_m; }
  double Height() const { return (rows + 1) * square_m; }

  /// Whether the square in `column` and `row` of the print, from (0, 0), is black.
  static bool IsBlack(int column, int row) { return (column + row) % 2 == 0; }
  /// The marker in a white square; -1 in a black one and on a checkerboard.
  int MarkerAt(int column, int row) const;
  int MarkerCount() const;

  /// A checkerboard that looks the same upside down: nobody can tell which of its corners is 0.
  bool LooksSameUpsideDown() const {
    return kind == Kind::kCheckerboard && columns % 2 == rows % 2;
  }

  bool operator==(const CalibrationBoard&) const = default;
};

/// "5x5_250"
std::string_view ToString(CalibrationBoard::Dictionary dictionary);
/// How many markers there are.
int MarkerCount(CalibrationBoard::Dictionary dictionary);

/// "checkerboard:7x6:50", "charuco:7x6:50:37.5:5x5_250": inner corners a row and a column, side of
/// a square, side of a marker, in millimetres. Numbers are read back as they were.
std::string ToText(const CalibrationBoard& board);
/// The reverse; a ChArUco board's marker and dictionary may be left out. Fails with
/// kInvalidOptions.
Result<CalibrationBoard> CalibrationBoardFromText(std::string_view text);

/// Corners of one board in one image; each corner at most once, in any order.
struct BoardView {
  std::vector<int> corner_ids;
  std::vector<Eigen::Vector2d> pixels;  ///< (0, 0) is the centre of the first pixel

  /// Names the corner at fault.
  Status Check(const CalibrationBoard& board) const;
};

}  // namespace foresight
