#pragma once

#include "core/depth/filter_window.h"

namespace foresight {

/// What a pixel's neighbourhood is compared with.
struct SupportModel {
  const SparseDepthMap& samples;
  double along_line_px;  ///< spacing of the samples
  double between_lines_px;
  double agreement_m;     ///< a sample this near to the pixel's plane supports it
  double nominal_weight;  ///< sum of G that a full neighbourhood would have
};

/// One image row of planes of inverse depth, rho = a + b dx + c dy.
struct PlaneRow {
  const float* depth_m;  ///< 1 / a; NaN = no plane
  const float* slope_x;
  const float* slope_y;
  const float* sum_gh;  ///< sum of G H over the filter's window
};

/// For each pixel of row `y` the probability that the lidar saw what it shows, from the samples
/// around it that agree with its plane; 0 where there is none. O(samples around the row * samples'
/// spacing).
void MeasureSupport(const SupportModel& model, int y, const PlaneRow& planes, float* confidence);

}  // namespace foresight
