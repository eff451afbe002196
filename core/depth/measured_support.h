#pragma once

#include <cstdint>
#include <span>

#include "core/depth/plane_filter.h"

namespace foresight {

/// What a pixel's neighbourhood is compared with.
struct SupportModel {
  const SparseDepthMap& samples;
  std::span<const SamplePlane> places;  ///< one a sample, for its ray
  double along_line_px;                 ///< spacing of the samples
  double between_lines_px;
  double agreement_m;     ///< a sample this near to the pixel's plane supports it
  double nominal_weight;  ///< sum of G that a full neighbourhood would have
};

/// One image row of planes of inverse depth, as FilterPlaneRows makes them.
struct PlaneRow {
  const float* depth_m;  ///< at the pixel; NaN = no plane
  const float* slope_x;  ///< over the rays' coordinates
  const float* slope_y;
  const float* sum_gkh;
  const float* sum_gk;
  const float* sum_gh;
  const float* ray_x;  ///< the pixels' own; null = columns and rows
  const float* ray_y;
  const std::uint8_t* inside;  ///< not 0 = in a connected cell
};

/// For each pixel of row `y` the probability that its depth is right, within 50 mm or 1 %; 0 where
/// there is none. It knows how many samples agree with the pixel's plane against what their spacing
/// promises, what share of those of its colour do, how near the nearest one is in cells of the
/// lidar's grid, whether there are some on each side, and whether the pixel lies inside a cell on
/// one surface. O(samples around the row * samples' spacing).
void MeasureSupport(const SupportModel& model, int y, const PlaneRow& planes, float* confidence);

/// How many rows away MeasureSupport still looks at samples.
int SupportReach(const SupportModel& model);

}  // namespace foresight
