#include "hardware/link/server/head_desk.h"

#include <gmock/gmock.h>

#include "core/mission/pose_json.h"
#include "core/sensor/rig_id.h"
#include "hardware/link/protocol/messages.h"
#include "tests/hardware/link/fake_head.h"
#include "tests/hardware/link/fake_stand.h"
#include "tests/support/pose_messages.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

using testing::HasSubstr;

class HeadDeskTest : public testing::Test {
 protected:
  HeadDeskTest() : shelf(ScanShelf::Open({folder / "scans", 0.9}).value()), desk(head, *shelf, {}) {
    link::ControlRequest take;
    token = desk.TakeControl(take, anna).token();
  }

  link::Command Command(const std::string& id) const {
    link::Command command;
    command.set_command_id(id);
    command.set_control_token(token);
    command.set_boot_id(desk.Identify(anna).boot_id());
    command.set_void_after_s(desk.Time() + 10.0);
    return command;
  }
  link::Command Home(const std::string& id) const {
    link::Command command = Command(id);
    command.mutable_home();
    return command;
  }
  link::Command Scan(const std::string& id, const std::string& uuid) const {
    link::Command command = Command(id);
    command.mutable_start_scan()->set_scan_id(uuid);
    command.mutable_start_scan()->set_plan_json(PlanToJson(ScanPlan()));
    return command;
  }

  const HeadDesk::Peer anna{"anna", true};
  const HeadDesk::Peer ben{"ben", true};
  const HeadDesk::Peer eve{"eve", false};
  const TemporaryFolder folder;
  const std::shared_ptr<FakeHead> head = std::make_shared<FakeHead>();
  const std::unique_ptr<ScanShelf> shelf;
  HeadDesk desk;
  std::string token;
};

struct StandDeskTest : HeadDeskTest {
  StandDeskTest() { token = with_stand.TakeControl({}, anna).token(); }
  link::Command Move(const std::string& id, int place) const {
    link::Command command = Command(id);
    command.set_boot_id(with_stand.boot_id());
    command.mutable_move_stand()->set_place(place);
    return command;
  }

  FakeStand stand;
  HeadDesk with_stand{head, *shelf, {60.0, true, nullptr, 0.0, &stand}};
};

TEST_F(StandDeskTest, ASimulatedHeadTellsOfItsStandAndMovesIt) {
  EXPECT_TRUE(with_stand.Identify(eve).has_stand());
  EXPECT_EQ(with_stand.Now(false).stand_at(), 1);
  EXPECT_EQ(with_stand.Execute(Move("1", 3), anna).error(), link::NONE);
  EXPECT_EQ(stand.at, 2);
  EXPECT_EQ(with_stand.Now(false).stand_at(), 3);
  with_stand.Execute(Move("1", 3), anna);
  EXPECT_EQ(stand.moves, 1) << "a repeat is not carried out";
}

TEST_F(StandDeskTest, AnObserverAndAPlaceThatIsNotThereMoveNothing) {
  EXPECT_EQ(with_stand.Execute(Move("1", 2), eve).error(), link::WRONG_STATE);
  EXPECT_EQ(with_stand.Execute(Move("2", 4), anna).error(), link::INVALID_INPUT);
  EXPECT_EQ(with_stand.Execute(Move("3", -1), anna).error(), link::INVALID_INPUT);
  EXPECT_EQ(stand.moves, 0);
}

TEST_F(StandDeskTest, WhileTheHeadCapturesTheStandStays) {
  head->SetState(HeadState::kSweeping);
  EXPECT_EQ(with_stand.Execute(Move("1", 2), anna).error(), link::WRONG_STATE);
  EXPECT_EQ(stand.moves, 0);
  head->SetState(HeadState::kReady);
  EXPECT_EQ(with_stand.Execute(Move("2", 2), anna).error(), link::NONE);
}

TEST_F(HeadDeskTest, AHeadWhoseStandIsCarriedSaysSo) {
  EXPECT_FALSE(desk.Identify(anna).has_stand());
  EXPECT_EQ(desk.Now(false).stand_at(), 0);
  link::Command command = Command("1");
  command.mutable_move_stand()->set_place(1);
  EXPECT_THAT(desk.Execute(command, anna).message(), HasSubstr("is carried"));
}

TEST_F(HeadDeskTest, NoRealHeadHasAStandThatMovesByItself) {
  FakeStand stand;
  EXPECT_ANY_THROW(HeadDesk(head, *shelf, {60.0, false, nullptr, 0.0, &stand}));
}

TEST_F(HeadDeskTest, ACommandThatComesTwiceIsCarriedOutOnce) {
  EXPECT_EQ(desk.Execute(Home("1"), anna).error(), link::NONE);
  const link::Outcome again = desk.Execute(Home("1"), anna);
  EXPECT_EQ(again.error(), link::NONE);
  EXPECT_TRUE(again.repeated());
  EXPECT_EQ(head->homings, 1);
}

TEST_F(HeadDeskTest, ARefusalIsRepeatedToo) {
  const link::Outcome first = desk.Execute(Scan("1", "a"), anna);  // not homed
  EXPECT_EQ(first.error(), link::WRONG_STATE);
  desk.Execute(Home("2"), anna);
  EXPECT_EQ(desk.Execute(Scan("1", "a"), anna).error(), link::WRONG_STATE)
      << "a command that was refused does not begin to work later";
  EXPECT_EQ(head->scans, 0);
}

TEST_F(HeadDeskTest, ACommandThatWaitedOutABlackoutIsRefused) {
  link::Command late = Home("1");
  late.set_void_after_s(desk.Time() - 3.0);
  const link::Outcome outcome = desk.Execute(late, anna);
  EXPECT_EQ(outcome.error(), link::WRONG_STATE);
  EXPECT_THAT(outcome.message(), HasSubstr("came 3.0 s too late"));
  EXPECT_EQ(head->homings, 0);
  late.set_command_id("2");
  late.set_void_after_s(std::numeric_limits<double>::quiet_NaN());
  EXPECT_NE(desk.Execute(late, anna).error(), link::NONE);
  EXPECT_EQ(head->homings, 0);
}

TEST_F(HeadDeskTest, ACommandForAnEarlierRunOfTheProgramIsRefused) {
  link::Command command = Home("1");
  command.set_boot_id("another one");
  EXPECT_THAT(desk.Execute(command, anna).message(), HasSubstr("started anew"));
  EXPECT_EQ(head->homings, 0);
}

TEST_F(HeadDeskTest, OnlyWhoHasControlCommands) {
  link::Command command = Home("1");
  command.clear_control_token();
  EXPECT_THAT(desk.Execute(command, ben).message(), HasSubstr("ben does not have control"));
  EXPECT_THAT(desk.Execute(Home("2"), eve).message(), HasSubstr("eve is an observer"));
  EXPECT_EQ(head->homings, 0);
  EXPECT_FALSE(desk.TakeControl({}, ben).granted());
  EXPECT_FALSE(desk.TakeControl({}, eve).granted());
}

TEST_F(HeadDeskTest, AnyOperatorStopsTheHeadAndAnObserverDoesNot) {
  EXPECT_EQ(desk.Stop(ben).error(), link::NONE);
  EXPECT_EQ(head->stops, 1);
  EXPECT_NE(desk.Stop(eve).error(), link::NONE);
  EXPECT_EQ(head->stops, 1);
}

TEST_F(HeadDeskTest, WhatWasAskedForBeforeAStopDoesNotBeginAfterIt) {
  link::Command early = Home("1");
  early.set_given_s(desk.Time());
  EXPECT_EQ(desk.Stop(ben).error(), link::NONE);
  const link::Outcome late = desk.Execute(early, anna);
  EXPECT_EQ(late.error(), link::WRONG_STATE);
  EXPECT_THAT(late.message(), HasSubstr("stopped after that was asked for: command again"));
  EXPECT_EQ(head->homings, 0);
  // What was asked for since is carried out, and what ends a scan is never void.
  link::Command since = Home("2");
  since.set_given_s(desk.Time() + 0.001);
  EXPECT_EQ(desk.Execute(since, anna).error(), link::NONE);
  EXPECT_EQ(head->homings, 1);
  link::Command end = Command("3");
  end.mutable_end_scan();
  end.set_given_s(early.given_s());
  EXPECT_THAT(desk.Execute(end, anna).message(), Not(HasSubstr("stopped after")));
}

TEST_F(HeadDeskTest, AStopVoidsWhatWasAskedForUntilItWasPressed) {
  link::Command command = Home("1");
  command.set_given_s(desk.Time());
  const double pressed_s = 0.5 * command.given_s();
  // It was pressed before, and came late.
  EXPECT_EQ(desk.Stop(anna, pressed_s).error(), link::NONE);
  EXPECT_EQ(desk.Execute(command, anna).error(), link::NONE);
  EXPECT_EQ(head->homings, 1);
  // A clock that runs ahead voids nothing to come.
  EXPECT_EQ(desk.Stop(anna, desk.Time() + 1000.0).error(), link::NONE);
  link::Command next = Home("2");
  next.set_given_s(desk.Time() + 0.001);
  EXPECT_EQ(desk.Execute(next, anna).error(), link::NONE);
}

TEST_F(HeadDeskTest, AStopThatComesWhileAMovementBeginsStopsItToo) {
  int stops_in_home = 0;
  head->on_home = [&] {
    desk.Stop(ben);
    stops_in_home = head->stops;
  };
  link::Command command = Home("1");
  command.set_given_s(desk.Time());
  EXPECT_EQ(desk.Execute(command, anna).error(), link::NONE);
  EXPECT_EQ(head->homings, 1);
  EXPECT_EQ(head->stops, stops_in_home + 1) << "the motor may have begun after the first one";
}

TEST_F(HeadDeskTest, AScanIsKeptUnderTheStationsName) {
  desk.Execute(Home("1"), anna);
  const link::Outcome started = desk.Execute(Scan("2", "scan-7"), anna);
  ASSERT_EQ(started.error(), link::NONE) << started.message();
  EXPECT_EQ(started.status().scan_id(), "scan-7");
  EXPECT_TRUE(shelf->Find("scan-7"));
  head->Play(SampleScan(4));
}

TEST_F(HeadDeskTest, AScanThatTheHeadRefusesLeavesNothingOnTheShelf) {
  EXPECT_EQ(desk.Execute(Scan("1", "scan-7"), anna).error(), link::WRONG_STATE);
  EXPECT_FALSE(shelf->Find("scan-7"));
}

TEST_F(HeadDeskTest, NamesThatAreNoneAreRefused) {
  desk.Execute(Home("1"), anna);
  int command = 2;
  for (const char* name : {"", "../../etc/passwd", "a b", "a\nb"})
    EXPECT_EQ(desk.Execute(Scan(std::to_string(command++), name), anna).error(),
              link::INVALID_INPUT);
  EXPECT_EQ(desk.Execute(Home(std::string(65, 'a')), anna).error(), link::INVALID_INPUT);
  EXPECT_EQ(head->scans, 0);
}

TEST_F(HeadDeskTest, APlanThatNoHeadExecutesIsRefused) {
  desk.Execute(Home("1"), anna);
  link::Command command = Scan("2", "a");
  command.mutable_start_scan()->set_plan_json("{\"from_rad\": 1e308}");
  EXPECT_EQ(desk.Execute(command, anna).error(), link::BAD_DATA);
  EXPECT_EQ(desk.Execute(Command("3"), anna).error(), link::INVALID_INPUT) << "no command at all";
}

TEST_F(HeadDeskTest, OnlyTheScanThatIsMeantIsEnded) {
  desk.Execute(Home("1"), anna);
  desk.Execute(Scan("2", "a"), anna);
  link::Command end = Command("3");
  end.mutable_end_scan()->set_scan_id("b");
  EXPECT_THAT(desk.Execute(end, anna).message(), HasSubstr("scan b does not run"));
  EXPECT_EQ(head->EndReason(), "");
  end.set_command_id("4");
  end.mutable_end_scan()->set_scan_id("a");
  end.mutable_end_scan()->set_reason("seen enough");
  EXPECT_EQ(desk.Execute(end, anna).error(), link::NONE);
  EXPECT_EQ(head->EndReason(), "seen enough");
  head->Play(SampleScan(4));
}

TEST_F(HeadDeskTest, ARigIsPutInForceAndReadBack) {
  SensorRig rig = DefaultSensorRig();
  rig.lidar.range_offset_m = 0.012;
  link::Command command = Command("1");
  command.mutable_set_rig()->set_yaml(SensorRigToYaml(rig));
  EXPECT_EQ(desk.Execute(command, anna).error(), link::NONE);
  EXPECT_EQ(desk.Now(false).rig_id(), RigId(rig));
  EXPECT_EQ(desk.RigYaml("").value(), SensorRigToYaml(rig));
  EXPECT_FALSE(desk.RigYaml(RigId(DefaultSensorRig())));
}

TEST_F(HeadDeskTest, APoseGoesToTheRobotOfWhoHasControl) {
  link::PoseRequest request;
  EXPECT_THAT(desk.PublishPose(request, anna).reason(), HasSubstr("anna does not have control"));
  request.set_control_token(token);
  EXPECT_THAT(desk.PublishPose(request, anna).reason(), HasSubstr("too late"));
  request.set_boot_id(desk.boot_id());
  request.set_void_after_s(desk.Time() - 1.0);
  EXPECT_THAT(desk.PublishPose(request, anna).reason(), HasSubstr("too late"));
  request.set_void_after_s(desk.Time() + 60.0);
  EXPECT_THAT(desk.PublishPose(request, anna).reason(), HasSubstr("--robot-socket"));
  request.set_boot_id("of the head before");
  EXPECT_THAT(desk.PublishPose(request, anna).reason(), HasSubstr("too late"));
}

TEST_F(HeadDeskTest, APoseIsJudgedByWhatTheHeadKnowsOfItsScan) {
  int sent = 0;
  PoseGate gate({}, [&](const PoseMessage&) {
    ++sent;
    return RobotAnswer{RobotAnswer::Kind::kAccepted, ""};
  });
  HeadDesk with_robot(head, *shelf, {60.0, true, &gate});
  link::PoseRequest request;
  request.set_control_token(with_robot.TakeControl({}, anna).token());
  request.set_boot_id(with_robot.boot_id());
  request.set_void_after_s(with_robot.Time() + 600.0);
  head->SetState(HeadState::kReady);
  PoseMessage pose = SamplePose();
  pose.scan_uuid = "scan-1";
  pose.simulated = true;
  pose.rig_id = RigId(head->Rig());
  request.set_pose_json(PoseMessageToJson(pose));
  EXPECT_EQ(with_robot.PublishPose(request, anna).answer(), "refused") << "no such scan here";
  EXPECT_EQ(sent, 0);
  const auto record = [&](const std::string& uuid) {
    ASSERT_TRUE(head->StartScan(ScanPlan(), shelf->Begin(uuid, {}).value()));
    foresight::Scan scan = SampleScan(4);
    scan.rig = head->Rig();
    head->Play(scan);
    while (shelf->Find(uuid)->state == ScanState::kRunning)
      shelf->WaitForNews(shelf->News(), std::chrono::milliseconds(100));
  };
  record("scan-1");
  pose.sending = 4;
  request.set_pose_json(PoseMessageToJson(pose));
  const link::PoseReply accepted = with_robot.PublishPose(request, anna);
  EXPECT_EQ(accepted.answer(), "accepted") << accepted.reason();
  EXPECT_TRUE(with_robot.PublishPose(request, anna).repeated());
  EXPECT_EQ(sent, 1);
  record("scan-2");
  pose.sending = 5;
  request.set_pose_json(PoseMessageToJson(pose));
  EXPECT_EQ(with_robot.PublishPose(request, anna).answer(), "refused") << "there is a newer scan";
  EXPECT_EQ(sent, 1);
}

TEST_F(HeadDeskTest, SignsOfLifeOfWhoHasControlReachTheHead) {
  EXPECT_TRUE(desk.SignOfLife(token));
  EXPECT_EQ(head->signs, 1);
  EXPECT_FALSE(desk.SignOfLife("a guess"));
  EXPECT_EQ(head->signs, 1);
}

}  // namespace
}  // namespace foresight
