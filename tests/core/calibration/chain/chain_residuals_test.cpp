#include "core/calibration/chain_residuals.h"

#include <cmath>

#include "tests/core/calibration/chain/calibrated_session.h"

namespace foresight {
namespace {

using samples::CalibratedSession;
using samples::CalibrateSimulated;

const CalibratedSession& SmallSession() {
  static const CalibratedSession session = [] {
    CalibrationSimulation options;
    options.seed = 4;
    options.intrinsic_views = 8;
    options.poses = 4;
    options.scans_per_stop = 10;
    options.sweeps = 1;
    return CalibrateSimulated(options);
  }();
  return session;
}

TEST(ChainResiduals, BoardsTogetherHaveTheWholesResiduals) {
  const ChainCalibration& found = SmallSession().found;
  const std::vector<BoardFit> boards = FitsOfBoards(found);
  ASSERT_EQ(boards.size(), 8u) << "two boards at four places";
  int returns = 0, corners = 0;
  double squares = 0.0;
  for (const BoardFit& board : boards) {
    returns += board.returns;
    corners += board.corners;
    squares += board.rms_m * board.rms_m * board.returns;
    EXPECT_LT(board.rms_px, 1.0) << "noise is 0.41 px";
    // A board's mean is as well known as its returns are many: some hundreds of 6 mm.
    EXPECT_LT(std::abs(board.mean_m), 0.003);
  }
  EXPECT_EQ(returns, found.ranges.count);
  EXPECT_GT(corners, 0);
  EXPECT_NEAR(std::sqrt(squares / returns), found.ranges.rms, 1e-9);
}

TEST(ChainResiduals, LidarPointsLieOnTheirBoardsOnlyAfterwards) {
  const CalibratedSession& session = SmallSession();
  const std::vector<LidarImagePoint> points =
      LidarOnImages(session.found, session.made.session.prior);
  ASSERT_GT(points.size(), 100u);
  double before = 0.0, after = 0.0, moved_px = 0.0;
  int count = 0;
  for (const LidarImagePoint& point : points) {
    ASSERT_TRUE(point.pixel_after.allFinite()) << "boards are in the image";
    EXPECT_LT(std::abs(point.residual_after_m), 0.1);
    if (!point.pixel_before.allFinite() || !std::isfinite(point.residual_before_m)) continue;
    before += point.residual_before_m * point.residual_before_m;
    after += point.residual_after_m * point.residual_after_m;
    moved_px += (point.pixel_after - point.pixel_before).norm();
    ++count;
  }
  // The prior is 5 deg and 100 mm off: 50 px.
  EXPECT_GT(before, 9.0 * after);
  EXPECT_GT(moved_px / count, 10.0);
}

}  // namespace
}  // namespace foresight
