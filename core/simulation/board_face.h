#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "core/base/result.h"
#include "core/objects/calibration_board.h"

namespace foresight {

/// How a printed board differs from its drawing. In frame::Pattern, with corner 0 in its place
/// but for its own jitter.
struct PrintErrors {
  Eigen::Vector2d scale = {1.0, 1.0};  ///< printed size by drawn size, along x and y
  double corner_jitter_m = 0.0;        ///< standard deviation of an inner corner's place an axis
  std::uint64_t seed = 1;              ///< of the jitter
  BoardWarp warp;

  /// Names the member at fault.
  Status Check(const CalibrationBoard& board) const;
};

/// What is printed on a board: white or ink at each point of its surface, which is given by its x
/// and y in frame::Pattern, as printed.
class BoardFace {
 public:
  BoardFace(const CalibrationBoard& board, const PrintErrors& errors);

  /// Where an inner corner is, with all errors.
  Eigen::Vector3d Corner(int id) const;
  /// How deep the warped surface lies at a point.
  double Depth(const Eigen::Vector2d& at) const;
  /// The corners of the squares' outline as printed, the first square's first, then clockwise.
  std::array<Eigen::Vector2d, 4> Outline() const;

  bool WhiteAt(const Eigen::Vector2f& at) const;
  /// The white part of a small quadrilateral, 0 to 1.
  float WhiteIn(const std::array<Eigen::Vector2f, 4>& quadrilateral) const;

 private:
  Eigen::Vector2f Jitter(const Eigen::Vector2f& drawn) const;

  CalibrationBoard board_;
  PrintErrors errors_;
  Eigen::Vector2f per_scale_;
  float per_square_;
  /// Of each inner corner, row by row.
  std::vector<Eigen::Vector2d> jitter_m_;
  int marker_cells_ = 0;                    ///< a side; 0 = no markers
  std::vector<std::vector<bool>> markers_;  ///< white cells of each
};

}  // namespace foresight
