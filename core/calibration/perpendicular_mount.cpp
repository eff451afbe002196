#include "core/calibration/perpendicular_mount.h"

namespace foresight {

BoardMount PerpendicularMount(const CalibrationBoard& a, const CalibrationBoard& b,
                              double hinge_m) {
  return {.a = a,
          .b = b,
          .a_from_b = {DefaultBoardMount().a_from_b.rotation(),
                       Eigen::Vector3d((a.columns - 1) * a.square_m + hinge_m, 0.0, -hinge_m)}};
}

}  // namespace foresight
