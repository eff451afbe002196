#pragma once

#include <optional>

#include "core/geometry/rigid.h"
#include "core/objects/calibration_board.h"

namespace foresight {

/// The frame of board A seen from that of board B of one stand.
using BoardFromBoard = Rigid<frame::Pattern, frame::Pattern>;

/// Two boards on one stand, about perpendicular to each other (Section III-B). The stand's frame is
/// that of board A.
struct BoardMount {
  CalibrationBoard a;
  std::optional<CalibrationBoard> b;
  BoardFromBoard a_from_b;  ///< as drawn; the true one is estimated

  Status Check() const;
  bool operator==(const BoardMount& other) const {
    return a == other.a && b == other.b &&
           a_from_b.rotation().coeffs() == other.a_from_b.rotation().coeffs() &&
           a_from_b.translation() == other.a_from_b.translation();
  }
};

/// From the nearest corners of boards with squares of 50 mm: the paper's margin, and a little.
inline constexpr double kHinge_m = 0.065;

/// Two boards at a right angle whose surfaces meet in a hinge along y, `hinge_m` beside the nearest
/// corners of both, open towards the viewer like a book.
BoardMount HingedMount(const CalibrationBoard& a, const CalibrationBoard& b, double hinge_m);

/// The same of two boards with 8 x 6 inner corners of 50 mm, as the paper's; images of
/// checkerboards do not tell which is which.
BoardMount DefaultBoardMount();
/// The same of checkerboards that images tell apart: 9 x 6 and 7 x 6 inner corners of 50 mm.
BoardMount UsualBoardMount();

}  // namespace foresight
