// Planes, and what bends them: a room made of planes without noise, seen by a rig that drifted.
#include "core/selfcheck/flat_cells.h"

#include <gtest/gtest.h>

#include "core/calibration/tangent.h"
#include "core/geometry/angles.h"
#include "core/selfcheck/check_rig.h"
#include "core/selfcheck/plate_check.h"

namespace foresight {
namespace {

/// What a lidar of the field reads off the true range of a wall of the box.
struct Misread {
  double near_end = 0.0;  ///< of the half length of a beam on the wall: 1 = its near end
  double stones_m = 0.0;  ///< walls of stones half a metre wide, each so much out or in
};

/// The range along a beam inside a box about the origin. The beam is 5 mrad wide and 12 high.
/// @param lines_axis the lidar's axis, which its lines are across
double RangeInBox(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                  const Eigen::Vector3d& lines_axis, const Eigen::Vector3d& half,
                  const Misread& misread) {
  double range = 1e9;
  int across = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0.0) continue;
    const double wall = direction[axis] > 0.0 ? half[axis] : -half[axis];
    const double to_wall = (wall - origin[axis]) / direction[axis];
    if (to_wall >= range) continue;
    range = to_wall;
    across = axis;
  }
  const double cosine = std::abs(direction[across]);
  const Eigen::Vector3d along_line = lines_axis.cross(direction);
  const double half_length =
      0.5 * range / cosine * std::hypot(0.005 * along_line[across], 0.012 * lines_axis[across]);
  const Eigen::Vector3d at = origin + range * direction;
  int stone = 0;
  for (int axis = 0; axis < 3; ++axis)
    if (axis != across) stone = 31 * stone + static_cast<int>(std::floor(at[axis] / 0.5));
  // 7, 13 and 5: no pattern along either axis.
  const double out =
      misread.stones_m * ((((stone * 7 + across) % 13 + 13) % 13 * 5) % 13 - 6) / 6.0;
  return range - misread.near_end * half_length + out / cosine;
}

/// A sweep up and, where asked for, down again at 20 deg/s in a box of 5 x 2.8 x 6 m, with ranges
/// in whole millimetres and no other noise.
Scan ScanOfBox(const SensorRig& true_rig, bool up_and_down, const Misread& misread = {}) {
  const Eigen::Vector3d half(2.5, 1.4, 3.0);
  constexpr double kSpeed_rad_s = 0.349, kPass_s = 3.0, kTurn_s = 0.2;
  const auto motor_at = [&](double time_s) {
    return time_s < kPass_s + 0.5 * kTurn_s ? -0.52 + kSpeed_rad_s * time_s
                                            : 0.527 - kSpeed_rad_s * (time_s - kPass_s - kTurn_s);
  };
  Scan scan;
  scan.rig = true_rig;
  const double end_s = up_and_down ? 2.0 * kPass_s + kTurn_s : kPass_s;
  for (double time_s = -0.1; time_s < end_s + 0.15; time_s += 1.0 / 240.0)
    scan.track.Add({time_s, motor_at(time_s)});
  const auto head_from_lidar = true_rig.HeadFromLidar();
  std::int64_t seq = 0;
  for (double start_s = 0.0; start_s < end_s; start_s += true_rig.lidar.period_s) {
    if (start_s > kPass_s && start_s < kPass_s + kTurn_s) continue;
    LidarLine line;
    line.seq = seq++;
    line.time_s = start_s;
    for (int beam = 0; beam < true_rig.lidar.beams; ++beam) {
      const double motor_rad = motor_at(start_s + true_rig.lidar.BeamTime(beam));
      const auto base_from_lidar = true_rig.BaseFromHead(motor_rad) * head_from_lidar;
      const double range =
          RangeInBox(base_from_lidar.translation(),
                     base_from_lidar.Rotate(true_rig.lidar.BeamDirection(beam)),
                     base_from_lidar.Rotate(Eigen::Vector3d::UnitZ()), half, misread) -
          true_rig.lidar.range_offset_m;
      line.range_mm.push_back(static_cast<std::uint16_t>(1000.0 * range + 0.5));
    }
    scan.lines.push_back(std::move(line));
  }
  return scan;
}

Result<PlateCheck> Check(const Scan& scan) {
  return CheckPlate(scan, RegisterScan(scan, {}).value(), PlateCheckOptions());
}

TEST(FlatCells, FindTheWallsOfABox) {
  const Scan scan = ScanOfBox(DefaultSensorRig(), false);
  const auto cells = FindFlatCells(scan, RegisterScan(scan, {}).value(), {});
  const auto planes = FindCoplanarCells(cells, {});
  // Front and both sides; of floor and ceiling a sweep to 30 deg sees a strip of 0.6 m.
  EXPECT_GE(planes.size(), 3u);
  for (const CoplanarCells& plane : planes) {
    // Normals are those of the walls to a millimetre a metre.
    EXPECT_GT(plane.normal.cwiseAbs().maxCoeff(), 0.999999);
    EXPECT_GT(plane.cells.size(), 30u);
  }
}

TEST(PlateCheck, FindsNothingWhereNothingDrifted) {
  const auto check = Check(ScanOfBox(DefaultSensorRig(), true));
  ASSERT_TRUE(check) << check.error().message;
  EXPECT_TRUE(check->up_and_down);
  // Whole millimetres and the steps between lines leave 0.01 deg and 0.1 ms.
  EXPECT_LT(std::abs(check->drift[PlateCheck::kTurnY]), RadiansFromDegrees(0.02));
  EXPECT_LT(std::abs(check->drift[PlateCheck::kTurnZ]), RadiansFromDegrees(0.02));
  EXPECT_LT(std::abs(check->drift[PlateCheck::kStamp]), 2e-4);
}

TEST(PlateCheck, RangesThatReadTheNearEndOfABeamAreNoTurn) {
  const auto check = Check(ScanOfBox(DefaultSensorRig(), true, {.near_end = 0.6}));
  ASSERT_TRUE(check) << check.error().message;
  EXPECT_NEAR(check->drift[PlateCheck::kTurnY], 0.0, RadiansFromDegrees(0.03));
  EXPECT_NEAR(check->drift[PlateCheck::kTurnZ], 0.0, RadiansFromDegrees(0.03));
  EXPECT_NEAR(check->drift[PlateCheck::kNearEnd], 0.6, 0.1);
}

TEST(PlateCheck, WallsOfStonesDoNotTellATurn) {
  const auto check = Check(ScanOfBox(DefaultSensorRig(), true, {.stones_m = 0.012}));
  ASSERT_TRUE(check) << check.error().message;
  // 600 patches scatter little; that stones are off as a whole shows when some are left out.
  const RigCheckLimits limits;
  for (const auto turn : {PlateCheck::kTurnY, PlateCheck::kTurnZ})
    EXPECT_GT(limits.seen_sigmas * check->Sigma(turn), limits.lidar_turn_rad);
}

TEST(PlateCheck, FindsATurnOfTheLidarAboutEachAxisButTheMotors) {
  const SensorRig rig = DefaultSensorRig();
  for (const auto unknown : {PlateCheck::kTurnY, PlateCheck::kTurnZ}) {
    SCOPED_TRACE(static_cast<int>(unknown));
    Eigen::Vector3d turn_in_head = Eigen::Vector3d::Zero();
    turn_in_head[unknown == PlateCheck::kTurnY ? 1 : 2] = RadiansFromDegrees(0.3);
    const Eigen::Vector3d turn_in_camera = rig.camera_from_head.Rotate(turn_in_head);
    SensorRig true_rig = rig;
    true_rig.camera_from_lidar = {RotationExp(turn_in_camera) * rig.camera_from_lidar.rotation(),
                                  rig.camera_from_lidar.translation()};
    Scan scan = ScanOfBox(true_rig, true);
    scan.rig = rig;
    const auto check = Check(scan);
    ASSERT_TRUE(check) << check.error().message;
    const auto other = unknown == PlateCheck::kTurnY ? PlateCheck::kTurnZ : PlateCheck::kTurnY;
    // A tenth of the drift: the planes are found in points that are bent by it.
    EXPECT_NEAR(check->drift[unknown], RadiansFromDegrees(0.3), RadiansFromDegrees(0.03));
    EXPECT_NEAR(check->drift[other], 0.0, RadiansFromDegrees(0.03));
  }
}

TEST(PlateCheck, FindsAnOffsetOfTheStampsFromUpAndDownAlone) {
  SensorRig true_rig = DefaultSensorRig();
  true_rig.lidar.stamp_offset_s = 0.010;
  for (const bool up_and_down : {true, false}) {
    Scan scan = ScanOfBox(true_rig, up_and_down);
    scan.rig = DefaultSensorRig();
    const auto check = Check(scan);
    ASSERT_TRUE(check) << check.error().message;
    EXPECT_EQ(check->up_and_down, up_and_down);
    if (up_and_down)
      EXPECT_NEAR(check->drift[PlateCheck::kStamp], 0.010, 5e-4);
    else
      EXPECT_TRUE(std::isinf(check->Sigma(PlateCheck::kStamp)));
  }
}

TEST(PlateCheck, AScanWithoutPlanesSaysSo) {
  Scan scan = ScanOfBox(DefaultSensorRig(), true);
  for (std::size_t i = 0; i < scan.lines.size(); ++i) {
    auto& ranges = scan.lines.Edit(i).range_mm;  // each call makes a copy
    std::fill(ranges.begin(), ranges.end(), std::uint16_t{1});
  }
  scan.lines.Edit(0).range_mm[540] = 2000;
  const auto check = Check(scan);
  ASSERT_FALSE(check);
  EXPECT_EQ(check.error().code, ErrorCode::kTooFewPoints);
}

}  // namespace
}  // namespace foresight
