// foresightctl calibrate robot from images of a board on the robot's hand, as a head takes them.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "core/base/atomic_file.h"
#include "core/calibration/hand_eye.h"
#include "core/calibration/tangent.h"
#include "core/geometry/angles.h"
#include "core/io/png.h"
#include "core/simulation/world.h"
#include "tests/support/run_program.h"
#include "tests/support/small_camera.h"
#include "tests/support/yaml_of_pose.h"

namespace foresight {
namespace {

using ::testing::HasSubstr;

/// A robot that holds a board before its head and turns it about three axes; the head is not where
/// the rig has it.
class CalibrateRobotFromImages : public ::testing::Test {
 protected:
  static constexpr int kSamples = 7;

  CalibrateRobotFromImages() {
    std::string scene =
        "foresight_scene: 1\nname: hand\nambient: 0.8\n"
        "materials: {paper: {color: [0.9, 0.9, 0.9], color2: [0.03, 0.03, 0.03]}}\n"
        "stands: [{name: board, a: 'checkerboard:7x6:60', material: paper}]\nplaces:\n";
    for (int i = 0; i < kSamples; ++i) {
      Eigen::Vector3d turn = Eigen::Vector3d::Zero();
      turn[i % 3] = (i % 2 == 0 ? 0.35 : -0.45) + 0.02 * i;
      // Without the turn the board faces the head.
      hands_.emplace_back(true_head_.robot_from_base.rotation() * RotationExp(turn) *
                              hand_from_board_.rotation().conjugate(),
                          Eigen::Vector3d(0.75, 0.04 * (i - 2), 1.35 + 0.02 * i));
      scene +=
          "  - {stand: board, robot_from_stand: " + Yaml(hands_.back() * hand_from_board_) + "}\n";
    }
    auto read = SceneFromYaml(scene, "scene.yaml");
    EXPECT_TRUE(read) << read.error().message;
    world_ = std::make_unique<World>(std::make_shared<const Scene>(std::move(*read)), true_head_,
                                     WorldOptions());
    SensorRig rig = true_head_;
    rig.angle_correction = world_->CalibratedCorrection();
    rig.robot_from_base = {Eigen::Quaterniond::Identity(), Eigen::Vector3d::Zero()};
    EXPECT_TRUE(SaveSensorRig(rig, folder_ / "rig.yaml"));
  }

  static double MotorRad(int sample) { return RadiansFromDegrees(-6.0 + 3.0 * sample); }

  void Photograph(int place, int sample) const {
    ASSERT_TRUE(world_->MoveStand(place));
    const CameraFrame frame = world_->CaptureImage(
        sample, 1.0, 0.004, 0.0, [sample](double) { return MotorRad(sample); }, {});
    ASSERT_TRUE(WritePng(folder_ / fmt::format("{}.png", sample), frame.image));
  }

  ProgramResult Calibrate(int samples) const {
    std::string yaml =
        "foresight_robot_frame: 1\nboards: on_hand\nboard: checkerboard:7x6:60\nsamples:\n";
    for (int i = 0; i < samples; ++i)
      yaml += fmt::format("  - {{robot_from_hand: {}, motor_deg: {}, image: {}.png}}\n",
                          Yaml(hands_[static_cast<std::size_t>(i)]),
                          DegreesFromRadians(MotorRad(i)), i);
    EXPECT_TRUE(WriteFileAtomically(folder_ / "robot.yaml", yaml));
    return RunProgram(FORESIGHTCTL,
                      {"calibrate", "robot", folder_ / "robot.yaml", "--rig", folder_ / "rig.yaml",
                       "--out", folder_ / "new.yaml", "--json"});
  }

  TemporaryFolder folder_;
  SensorRig true_head_ = SmallCameraRig();
  Rigid<frame::Hand, frame::Pattern> hand_from_board_{RotationExp({0.1, 0.2, -0.3}),
                                                      Eigen::Vector3d(-0.18, -0.15, 0.05)};
  std::vector<Rigid<frame::Robot, frame::Hand>> hands_;
  std::unique_ptr<World> world_;
};

TEST_F(CalibrateRobotFromImages, FindsWhereTheHeadStands) {
  for (int i = 0; i < kSamples; ++i) ASSERT_NO_FATAL_FAILURE(Photograph(i + 1, i));
  const ProgramResult result = Calibrate(kSamples);
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto json = nlohmann::json::parse(result.output);
  EXPECT_EQ(json["samples"], kSamples);
  EXPECT_TRUE(json["left_out"].empty()) << json["left_out"];
  const auto rig = LoadSensorRig(folder_ / "new.yaml");
  ASSERT_TRUE(rig) << rig.error().message;
  const auto off = StepBetween(rig->robot_from_base, true_head_.robot_from_base);
  // Corners are good to 0.1 px of 150 px a radian; it is off by 0.04 deg and 0.5 mm.
  EXPECT_LT(DegreesFromRadians(off.head<3>().norm()), 0.15);
  EXPECT_LT(off.tail<3>().norm(), 0.002);
}

TEST_F(CalibrateRobotFromImages, LeavesImagesWithoutTheBoardOutByName) {
  for (int i = 0; i < kSamples; ++i)
    ASSERT_NO_FATAL_FAILURE(Photograph(i == 3 ? 0 : i + 1, i));  // 0: the stand is away
  const ProgramResult result = Calibrate(kSamples);
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto json = nlohmann::json::parse(result.output);
  EXPECT_EQ(json["samples"], kSamples - 1);
  ASSERT_EQ(json["left_out"].size(), 1u);
  EXPECT_EQ(json["left_out"][0], "3.png: the board was not found");
}

TEST_F(CalibrateRobotFromImages, SaysWhatIsWrongWithTheImages) {
  for (int i = 0; i < 3; ++i) ASSERT_NO_FATAL_FAILURE(Photograph(i == 2 ? 0 : i + 1, i));
  const ProgramResult few = Calibrate(3);
  EXPECT_EQ(few.exit_code, 1) << few.errors;
  EXPECT_THAT(few.errors, HasSubstr("2 samples"));
  const ProgramResult missing = Calibrate(4);
  EXPECT_EQ(missing.exit_code, 3);
  EXPECT_THAT(missing.errors, HasSubstr("3.png"));
  EXPECT_EQ(missing.ErrorLines(), 1) << missing.errors;
  ASSERT_TRUE(WritePng(folder_ / "2.png", GrayImage(64, 48, 128)));
  const ProgramResult small = Calibrate(3);
  EXPECT_EQ(small.exit_code, 3);
  EXPECT_THAT(small.errors, HasSubstr("2.png: 64 x 48 pixels, the rig's camera has"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "new.yaml"));
}

}  // namespace
}  // namespace foresight
