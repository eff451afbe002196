// A fresh session of boards against a rig.
#include "core/selfcheck/check_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/calibration/tangent.h"
#include "core/evaluation/simulate_calibration.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

using testing::Contains;
using testing::HasSubstr;

const SimulatedCalibration& Session() {
  static const SimulatedCalibration kSession = [] {
    CalibrationSimulation options;
    options.seed = 5;
    options.intrinsic_views = 0;
    options.poses = 4;
    return SimulateCalibration(options).value();
  }();
  return kSession;
}

SessionCheck Check(const SensorRig& rig) {
  auto check = CheckSession(Session().session, rig, {}, {});
  EXPECT_TRUE(check) << check.error().message;
  return check ? *check : SessionCheck();
}

TEST(CheckSession, IsQuietAboutTheTrueRig) {
  EXPECT_THAT(Check(Session().truth).drifted, testing::IsEmpty());
}

TEST(CheckSession, SaysThatTheLidarTurned) {
  SensorRig rig = Session().truth;
  rig.camera_from_lidar = {
      rig.camera_from_lidar.rotation() * RotationExp({0.0, 0.0, RadiansFromDegrees(-0.3)}),
      rig.camera_from_lidar.translation()};
  const SessionCheck check = Check(rig);
  EXPECT_THAT(check.drifted, Contains(HasSubstr("lidar's z axis: off by 0.3")));
}

TEST(CheckSession, SaysThatTheCameraTurnedOnThePlate) {
  SensorRig rig = Session().truth;
  const Eigen::Quaterniond turn = RotationExp({0.0, RadiansFromDegrees(0.3), 0.0});
  rig.camera_from_head = {turn * rig.camera_from_head.rotation(),
                          turn * rig.camera_from_head.translation()};
  EXPECT_THAT(Check(rig).drifted, Contains(HasSubstr("the motor's axis, about the head's y axis")));
}

TEST(CheckSession, SaysThatTheLensChanged) {
  SensorRig rig = Session().truth;
  rig.camera.lens = FisheyeLens{1.0};
  EXPECT_THAT(Check(rig).drifted, Contains(HasSubstr("corners as the rig's camera has them")));
}

}  // namespace
}  // namespace foresight
