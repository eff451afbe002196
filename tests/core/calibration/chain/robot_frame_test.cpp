// The robot's frame from a file of samples.
#include "core/calibration/robot_frame.h"

#include <gmock/gmock.h>

#include "core/base/atomic_file.h"
#include "core/calibration/tangent.h"
#include "core/geometry/angles.h"
#include "core/objects/calibration_board.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/yaml_of_pose.h"

namespace foresight {
namespace {

using ::testing::HasSubstr;

/// A head that sees a board on the hand at several turns of hand and motor.
class RobotFrame : public ::testing::Test {
 protected:
  RobotFrame() {
    for (int i = 0; i < 8; ++i) {
      Eigen::Vector3d turn = Eigen::Vector3d::Zero();
      turn[i % 3] = (i % 2 == 0 ? 0.4 : -0.5) + 0.02 * i;
      // The board faces the head: its z is the robot's forward.
      const Rigid<frame::Robot, frame::Hand> hand(
          rig_.robot_from_base.rotation() * RotationExp(turn) *
              hand_from_board_.rotation().conjugate(),
          Eigen::Vector3d(1.1, 0.05 * (i - 4), 1.2 + 0.03 * i));
      hands_.push_back(hand);
    }
  }

  Rigid<frame::Base, frame::Pattern> BaseFromBoard(std::size_t i) const {
    return rig_.robot_from_base.Inverse() * hands_[i] * hand_from_board_;
  }
  double MotorDeg(std::size_t i) const { return -10.0 + 2.0 * static_cast<double>(i); }

  /// Corners as the camera would see them, without noise.
  std::string Corners(std::size_t i) const {
    const auto camera_from_board =
        rig_.CameraFromBase(RadiansFromDegrees(MotorDeg(i))) * BaseFromBoard(i);
    std::string text = "board,corner,u,v\n";
    for (int id = 0; id < board_.CornerCount(); ++id) {
      const auto pixel = rig_.camera.Project(camera_from_board * board_.Corner(id));
      EXPECT_TRUE(pixel);
      text += fmt::format("a,{},{},{}\n", id, pixel->x(), pixel->y());
    }
    return text;
  }

  Result<RobotFrameSamples> Read(const std::string& yaml) const {
    EXPECT_TRUE(WriteFileAtomically(folder_ / "robot.yaml", yaml));
    return ReadRobotFrameSamples(folder_ / "robot.yaml", rig_, {});
  }

  TemporaryFolder folder_;
  SensorRig rig_ = DefaultSensorRig();
  CalibrationBoard board_ = CalibrationBoardFromText("checkerboard:7x6:30").value();
  Rigid<frame::Hand, frame::Pattern> hand_from_board_{RotationExp({0.1, 0.2, -0.3}),
                                                      Eigen::Vector3d(0.02, 0.01, 0.1)};
  std::vector<Rigid<frame::Robot, frame::Hand>> hands_;
};

TEST_F(RobotFrame, FindsTheMountFromCornersOfABoardOnTheHand) {
  std::string yaml =
      "foresight_robot_frame: 1\nboards: on_hand\nboard: checkerboard:7x6:30\nsamples:\n";
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    const std::string file = fmt::format("{}.csv", i);
    EXPECT_TRUE(WriteFileAtomically(folder_ / file, Corners(i)));
    yaml += fmt::format("  - {{robot_from_hand: {}, motor_deg: {}, corners: {}}}\n",
                        Yaml(hands_[i]), MotorDeg(i), file);
  }
  const auto samples = Read(yaml);
  ASSERT_TRUE(samples) << samples.error().message;
  ASSERT_EQ(samples->samples.size(), hands_.size()) << samples->left_out.front();
  const auto found = CalibrateRobotFrame(*samples, {});
  ASSERT_TRUE(found) << found.error().message;
  // Exact corners: what is left is where the board's pose stops converging.
  EXPECT_LT(StepBetween(rig_.robot_from_base, found->found.robot_from_base).norm(), 1e-5);
  EXPECT_LT(StepBetween(hand_from_board_, found->found.hand_from_board).norm(), 1e-5);
  EXPECT_LT(found->residuals.front().shift_m, 1e-5);
}

TEST_F(RobotFrame, FindsTheMountFromOneSurveyedBoard) {
  const auto samples =
      Read(fmt::format("foresight_robot_frame: 1\nboards: surveyed\nsamples:\n"
                       "  - {{name: wall, robot_from_board: {}, base_from_board: {}}}\n",
                       Yaml(hands_[0] * hand_from_board_), Yaml(BaseFromBoard(0))));
  ASSERT_TRUE(samples) << samples.error().message;
  EXPECT_EQ(samples->source, RobotFrameSource::kSurveyedBoards);
  const auto found = CalibrateRobotFrame(*samples, {});
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_LT(StepBetween(rig_.robot_from_base, found->found.robot_from_base).norm(), 1e-9);
}

TEST_F(RobotFrame, OneWayOfTurningIsRefusedInWords) {
  std::string yaml = "foresight_robot_frame: 1\nboards: on_hand\nsamples:\n";
  for (int i = 0; i < 6; ++i) {
    const Rigid<frame::Robot, frame::Hand> hand(RotationExp({0.0, 0.0, 0.2 * i}),
                                                Eigen::Vector3d(0.8, 0.0, 1.0));
    yaml += fmt::format("  - {{robot_from_hand: {}, base_from_board: {}}}\n", Yaml(hand),
                        Yaml(rig_.robot_from_base.Inverse() * hand * hand_from_board_));
  }
  const auto samples = Read(yaml);
  ASSERT_TRUE(samples) << samples.error().message;
  const auto found = CalibrateRobotFrame(*samples, {});
  ASSERT_FALSE(found);
  EXPECT_THAT(found.error().message, HasSubstr("about one axis only"));
}

TEST_F(RobotFrame, AFileThatMakesNoSenseIsRefusedWithItsLine) {
  const std::string pose = Yaml(hands_[0]);
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"foresight_robot_frame: 2\nboards: on_hand\n", "robot.yaml:1: version 2"},
      {"foresight_robot_frame: 1\nboards: in_hand\n", "'in_hand' is not on_hand or surveyed"},
      {"foresight_robot_frame: 1\nboards: on_hand\nboard: checkerboard:8x6:30\n",
       "looks the same upside down"},
      {"foresight_robot_frame: 1\nboards: on_hand\nsamples:\n  - {robot_from_hand: " + pose + "}\n",
       "one of them"},
      {"foresight_robot_frame: 1\nboards: on_hand\nsamples:\n  - {robot_from_hand: " + pose +
           ", corners: ../a.csv, motor_deg: 0}\n",
       "is not a file in the session's folder"},
      {"foresight_robot_frame: 1\nboards: on_hand\nsamples:\n  - {robot_from_hand: " + pose +
           ", corners: a.csv, motor_deg: 0}\n",
       "need a 'board'"},
      {"foresight_robot_frame: 1\nboards: on_hand\nboard: checkerboard:7x6:30\nsamples:\n"
       "  - {robot_from_hand: " +
           pose + ", corners: a.csv, motor_deg: 0}\n",
       "a.csv"}};
  for (const auto& [yaml, message] : cases) {
    const auto samples = Read(yaml);
    ASSERT_FALSE(samples) << yaml;
    EXPECT_THAT(samples.error().message, HasSubstr(message));
  }
}

}  // namespace
}  // namespace foresight
