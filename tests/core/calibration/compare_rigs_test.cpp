// How one rig differs from another one, where the difference is known.
#include "core/calibration/compare_rigs.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace foresight {
namespace {

/// The rig of the camera turned by an angle.
SensorRig Turned(double angle_rad, const Eigen::Vector3d& axis) {
  SensorRig rig = DefaultSensorRig();
  const Rigid<frame::Camera, frame::Camera> turn(
      Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, axis)), Eigen::Vector3d::Zero());
  rig.camera_from_head = turn * rig.camera_from_head;
  return rig;
}

/// Across the motor's axis, in camera.
Eigen::Vector3d AcrossAxis() {
  return DefaultSensorRig().camera_from_head.Rotate(Eigen::Vector3d::UnitY());
}

constexpr double kRounding = 1e-9;

TEST(CompareRigs, SaysHowFarTheAxisIsTurnedUpToItsOpposite) {
  for (const double angle_rad : {0.0, 0.3, 1.2, 2.0, M_PI - 0.01})
    EXPECT_NEAR(CompareRigs(Turned(angle_rad, AcrossAxis()), DefaultSensorRig()).value().axis_rad,
                angle_rad, kRounding);
}

TEST(CompareRigs, SaysHowFarTheLidarIsOff) {
  const SensorRig before = DefaultSensorRig();
  SensorRig rig = before;
  const Rigid<frame::Lidar, frame::Lidar> off(
      Eigen::Quaterniond(Eigen::AngleAxisd(0.02, Eigen::Vector3d::UnitZ())),
      Eigen::Vector3d(0.003, 0.0, 0.004));
  rig.camera_from_lidar = before.camera_from_lidar * off;
  rig.lidar.range_offset_m = before.lidar.range_offset_m - 0.012;
  rig.lidar.stamp_offset_s = before.lidar.stamp_offset_s + 0.001;
  const RigError error = CompareRigs(rig, before).value();
  EXPECT_NEAR(error.lidar_rad, 0.02, kRounding);
  EXPECT_NEAR(error.lidar_m, 0.005, kRounding);
  EXPECT_NEAR(error.range_offset_m, -0.012, kRounding);
  EXPECT_NEAR(error.stamp_offset_s, 0.001, kRounding);
}

TEST(CompareRigs, ComparesPlateAnglesAtTheKnotsOfBothAgainstThatAtZero) {
  const SensorRig before = DefaultSensorRig();
  SensorRig rig = before;
  // One offset for all angles is none; at the two ends 1 and 2 mrad remain.
  rig.angle_correction =
      AngleCorrection::FromKnots({{-0.5, -0.489}, {0.0, 0.01}, {1.0, 1.012}}).value();
  SensorRig none = before;
  none.angle_correction = AngleCorrection();
  const RigError error = CompareRigs(rig, none).value();
  EXPECT_NEAR(error.angles_most_rad, 0.002, kRounding);
  EXPECT_NEAR(error.angles_rms_rad, std::sqrt(2.5) * 1e-3, kRounding);
}

}  // namespace
}  // namespace foresight
