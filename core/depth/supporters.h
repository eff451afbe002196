#pragma once

#include "core/depth/filter_scratch.h"
#include "core/depth/measured_support.h"

namespace foresight {

/// A row of planes and the supporters found for each pixel, with margins that a register may touch.
struct RowSupport {
  /// inverse depth at x = y = 0 (NaN = no plane), slope_x, slope_y, distance of the nearest
  /// supporter in cells; a plane of one row each.
  PaddedRows values;
  std::vector<std::int32_t> sides;
  int margin = 0;

  float* AtOrigin() { return values.Row(0, 0) + margin; }
  float* SlopeX() { return values.Row(1, 0) + margin; }
  float* SlopeY() { return values.Row(2, 0) + margin; }
  float* Nearest() { return values.Row(3, 0) + margin; }
  std::int32_t* Sides() { return sides.data() + margin; }
};

/// Looks at the samples round row `y`: lowers Nearest and adds to Sides where one lies on a pixel's
/// plane. In the widest registers there are.
void FindSupporters(const SupportModel& model, int y, RowSupport& row);

}  // namespace foresight
