#pragma once

#include <Eigen/Core>

#include "core/base/result.h"
#include "core/base/shared_array.h"

namespace foresight {

/// A cloud that another program measured and placed, on a grid of lines and beams: what a scan has
/// in place of lidar lines and a motor's track where it was imported. Arrays have lines * beams
/// entries, row by row; copies share them.
struct GivenCloud {
  static constexpr int kMostBeams = 100'000;
  static constexpr int kMostLines = 10'000'000;
  static constexpr std::size_t kMostCells = 100'000'000;
  static constexpr float kFarthest_m = 200'000.0f;

  int lines = 0;
  int beams = 0;
  SharedArray<Eigen::Vector3f> points;   ///< in base, metres; NaN = no return
  SharedArray<float> intensity;          ///< in the file's units; empty = not known
  SharedArray<double> time_s;            ///< on the scan's clock; empty = not known
  SharedArray<Eigen::Vector3f> origins;  ///< one a line: where it was measured from, in base

  bool empty() const { return lines == 0; }
  std::size_t Index(int line, int beam) const {
    return static_cast<std::size_t>(line) * static_cast<std::size_t>(beams) +
           static_cast<std::size_t>(beam);
  }
  /// Of the first point that has a time; 0 where none has.
  double FirstTime_s() const;

  /// Fails with kInvalidInput, naming what is wrong: sizes that do not fit, a coordinate beyond
  /// 200 km, a point in a line without an origin.
  Status Check() const;

  /// Bit for bit: NaN equals NaN.
  bool operator==(const GivenCloud& other) const;
};

}  // namespace foresight
