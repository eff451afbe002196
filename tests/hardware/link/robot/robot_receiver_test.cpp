// The receiver of the docs against the real socket.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include "core/mission/pose_json.h"
#include "hardware/link/robot/pose_gate.h"
#include "hardware/link/robot/robot_socket.h"
#include "tests/support/pose_messages.h"
#include "tests/support/running_program.h"

namespace foresight {
namespace {

using testing::HasSubstr;
using Kind = RobotAnswer::Kind;

class RobotReceiver : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(FORESIGHT_PYTHON3)) GTEST_SKIP() << "there is no python3 here";
    Start();
  }
  void Start() {
    receiver_.emplace(
        FORESIGHT_PYTHON3,
        std::vector<std::string>{FORESIGHT_SOURCE_DIR "/docs/examples/robot_receiver.py",
                                 Path().string()});
    ASSERT_TRUE(WaitUntil([&] { return socket_->RobotIsThere(); }));
  }
  void Kill() {
    receiver_->Signal(SIGKILL);
    ASSERT_EQ(receiver_->Wait().exit_code, 128 + SIGKILL);
    receiver_.reset();
    ASSERT_TRUE(WaitUntil([&] { return !socket_->RobotIsThere(); }));
  }
  std::filesystem::path Path() const { return folder_ / "robot.sock"; }
  /// How often the receiver carried a pose out.
  int Actions() const {
    const std::string output = receiver_->Output();
    return static_cast<int>(std::count(output.begin(), output.end(), '\n'));
  }

  TemporaryFolder folder_;
  std::unique_ptr<RobotSocket> socket_ =
      RobotSocket::Listen({Path(), std::chrono::milliseconds(30'000)}).value();
  std::optional<RunningProgram> receiver_;
};

TEST_F(RobotReceiver, AcceptsAPoseThatItCanUse) {
  EXPECT_EQ(socket_->Send(SamplePose()), (RobotAnswer{Kind::kAccepted, ""}));
  EXPECT_THAT(receiver_->Output(), HasSubstr("accepted  " + SamplePose().Id()));
}

TEST_F(RobotReceiver, RefusesAPoseThatItCannotUseAndSaysWhy) {
  PoseMessage pose = SamplePose();
  pose.frame = PoseMessage::Frame::kBase;
  EXPECT_EQ(
      socket_->Send(pose),
      (RobotAnswer{Kind::kRefused, "the rig does not know how the head is mounted on the robot"}));
}

TEST_F(RobotReceiver, CarriesADuplicateOutOnce) {
  EXPECT_EQ(socket_->Send(SamplePose()).kind, Kind::kAccepted);
  EXPECT_EQ(socket_->Send(SamplePose()).kind, Kind::kAccepted);
  EXPECT_EQ(Actions(), 1);
}

TEST_F(RobotReceiver, IsServedAgainAfterARestartAndTheHeadRemembersForIt) {
  PoseGate gate({}, [this](const PoseMessage& message) { return socket_->Send(message); });
  const HeadFacts head{SamplePose().rig_id, false, [](const std::string&) {
                         return ScanAtHead{SamplePose().rig_id, false, 0.0, true};
                       }};
  PoseMessage pose = SamplePose();
  EXPECT_EQ(gate.Publish(PoseMessageToJson(pose), head).answer.kind, Kind::kAccepted);
  Kill();
  Start();
  EXPECT_TRUE(gate.Publish(PoseMessageToJson(pose), head).repeated);
  EXPECT_EQ(Actions(), 0) << "the new receiver heard nothing of the old pose";
  ++pose.sending;
  EXPECT_EQ(gate.Publish(PoseMessageToJson(pose), head).answer.kind, Kind::kAccepted);
  EXPECT_EQ(Actions(), 1);
}

TEST_F(RobotReceiver, ASecondOneEndsAndSaysWhy) {
  const ProgramResult second = RunProgram(
      FORESIGHT_PYTHON3, {FORESIGHT_SOURCE_DIR "/docs/examples/robot_receiver.py", Path().string()},
      {.seconds = 30});
  EXPECT_EQ(second.exit_code, 1);
  EXPECT_EQ(second.errors, "another robot is connected\n");
  EXPECT_EQ(socket_->Send(SamplePose()).kind, Kind::kAccepted);
}

}  // namespace
}  // namespace foresight
