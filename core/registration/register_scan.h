#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/base/shared_array.h"
#include "core/sensor/scan.h"

namespace foresight {

/// A scan's points on the grid they were measured on: rows are lidar lines in time order, columns
/// are beams. All arrays have lines * beams entries, row by row. Copies share them.
struct RegisteredScan {
  int lines = 0;
  int beams = 0;
  SharedArray<Eigen::Vector3f> points;  ///< in base, metres; NaN = no return
  SharedArray<float> range_m;    ///< along the beam, with the calibrated offset; NaN = no return
  SharedArray<float> intensity;  ///< device units; 0 where the lidar gives none
  SharedArray<Eigen::Vector3f>
      origins;  ///< one a line: where the lidar was, in base (middle of the line)

  std::size_t Index(int line, int beam) const {
    return static_cast<std::size_t>(line) * static_cast<std::size_t>(beams) +
           static_cast<std::size_t>(beam);
  }
  bool Valid(int line, int beam) const { return range_m[Index(line, beam)] > 0.0f; }
};

/// Places every return in base (an imported scan's given cloud is there already): the motor's angle
/// is interpolated at each beam's own time, so a line taken while the plate turns is not bent.
/// Returns outside the lidar's range or without a motor angle become NaN. Fails with kInvalidInput
/// when a line has another number of beams than the rig's lidar, and with kTooFewPoints when no
/// line has a return; as GivenCloud::Check. O(points).
Result<RegisteredScan> RegisterScan(const Scan& scan, const RunContext& context);

}  // namespace foresight
