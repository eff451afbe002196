#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/io/cloud_table.h"

namespace foresight {

/// Where the points of a cloud belong on a grid of lines and beams.
struct GridPlaces {
  /// How the grid was found.
  enum class Kind {
    kNumbers,    ///< by the line and beam that the file says of each point
    kRows,       ///< the file's own rows
    kRings,      ///< turns of a spinning lidar, one laser after the other
    kSweeps,     ///< lines of a scanner that begins each line where it began the one before
    kScattered,  ///< none was found: no two points are neighbours
  };
  Kind kind = Kind::kScattered;
  int lines = 0;
  int beams = 0;
  std::vector<std::int32_t> line;  ///< of each point; -1 = the point is none
  std::vector<std::int32_t> beam;
  double step_rad = 0.0;  ///< between neighbouring beams; 0 = not known

  /// Whether it is taken for the grid of a fan that is turned, line after line, and not for that of
  /// a spinning lidar or a camera. Who writes lines and beams, as our own clouds do, has a fan.
  bool IsOfAFan() const { return kind == Kind::kSweeps || kind == Kind::kNumbers; }
};

/// The order of a cloud's points: a scanner writes a line after the other, and within a line the
/// directions turn one way. `rings` = the laser of each point where the file knows it (-1 = not
/// known), else empty. Directions are those from `viewpoint`. Points that are not finite, or at the
/// viewpoint, have no place. Where no order is found the answer is kScattered: every point has a
/// place without neighbours. O(n log n).
GridPlaces RecoverGrid(std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& viewpoint,
                       std::span<const std::int32_t> rings = {});

/// The same for points whose place on a grid of rows the file says: width points a row. Rows are
/// lines. @pre points.size() is a multiple of width
GridPlaces GridOfRows(std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& viewpoint,
                      std::size_t width);

/// The same for points whose line and beam the file says. Fails with kBadData where two points have
/// one place, a point has none, or the grid has far more places than points.
Result<GridPlaces> GridOfNumbers(std::span<const Eigen::Vector3d> points,
                                 const Eigen::Vector3d& viewpoint,
                                 std::span<const std::int32_t> line,
                                 std::span<const std::int32_t> beam);

/// The best of these that a file's columns allow; `points` are the file's, in any frame. Fails as
/// GridOfNumbers does.
Result<GridPlaces> GridOfTable(const CloudTable& cloud, std::span<const Eigen::Vector3d> points,
                               const Eigen::Vector3d& viewpoint);

}  // namespace foresight
