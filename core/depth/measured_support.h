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

/// A pixel's plane of inverse depth, rho = a + b dx + c dy.
struct PixelPlane {
  float inverse_depth;
  float slope_x;
  float slope_y;
};

/// Probability that the lidar saw what this pixel shows, from the samples around it that agree with
/// its plane. @param sum_gh sum of G H over the filter's window.
float MeasuredSupport(const SupportModel& model, int x, int y, const PixelPlane& plane,
                      float sum_gh);

}  // namespace foresight
