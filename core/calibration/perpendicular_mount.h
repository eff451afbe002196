#pragma once

#include "core/calibration/calibration_session.h"

namespace foresight {

/// Two boards whose surfaces meet at a right angle in a hinge along y, open towards the viewer like
/// a book; the inner corners next to the hinge are `hinge_m` away from it. DefaultBoardMount is
/// one.
BoardMount PerpendicularMount(const CalibrationBoard& a, const CalibrationBoard& b, double hinge_m);

}  // namespace foresight
