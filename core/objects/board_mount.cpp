#include "core/objects/board_mount.h"

namespace foresight {

Status BoardMount::Check() const {
  FORESIGHT_CHECK(a.Check());
  if (b) FORESIGHT_CHECK(b->Check());
  return {};
}

BoardMount HingedMount(const CalibrationBoard& a, const CalibrationBoard& b, double hinge_m) {
  Eigen::Matrix3d turn;  // x of B towards the viewer, z of B along x of A
  turn << 0, 0, 1,       //
      0, 1, 0,           //
      -1, 0, 0;
  return {
      .a = a,
      .b = b,
      .a_from_b = {turn, Eigen::Vector3d((a.columns - 1) * a.square_m + hinge_m, 0.0, -hinge_m)}};
}

BoardMount DefaultBoardMount() {
  CalibrationBoard board;
  board.columns = 8;
  board.rows = 6;
  board.square_m = 0.050;
  return HingedMount(board, board, kHinge_m);
}

BoardMount UsualBoardMount() {
  CalibrationBoard a;
  a.columns = 9;
  a.rows = 6;
  a.square_m = 0.050;
  CalibrationBoard b = a;
  b.columns = 7;
  return HingedMount(a, b, kHinge_m);
}

}  // namespace foresight
