#include <gtest/gtest.h>

#include "core/mission/pose_json.h"
#include "core/sensor/rig_id.h"
#include "tests/ui/linked_head.h"
#include "tests/ui/synthetic_scan.h"
#include "tests/ui/wait_for.h"
#include "ui/viewmodels/bytes_text.h"
#include "ui/viewmodels/link_view_model.h"
#include "ui/viewmodels/log_model.h"
#include "ui/viewmodels/scan_flow.h"
#include "ui/viewmodels/send_pose_model.h"

namespace foresight {
namespace {

struct LinkTest : testing::Test {
  LinkTest() {
    head->link.health.connected = head->link.health.has_control = true;
    head->link.health.address = "robot:47130";
  }
  std::shared_ptr<LinkedHead> head = std::make_shared<LinkedHead>(DefaultSensorRig());
};

LinkedScan ScanThatIs(LinkedScan::Place place, const std::string& id) {
  LinkedScan scan;
  scan.scan_id = id;
  scan.place = place;
  scan.begin_utc_ns = 1'700'000'000'000'000'000;
  scan.lines = 62;
  scan.of_lines = 89;
  scan.images = 1;
  scan.of_images = 3;
  scan.left_bytes = 3'100'000;
  return scan;
}

TEST(BytesText, HasTwoDigits) {
  EXPECT_EQ(BytesText(0).toStdString(), "0 B");
  EXPECT_EQ(BytesText(999).toStdString(), "999 B");
  EXPECT_EQ(BytesText(1240).toStdString(), "1.2 kB");
  EXPECT_EQ(BytesText(34'400).toStdString(), "34 kB");
  EXPECT_EQ(BytesText(999'600).toStdString(), "1.0 MB");
  EXPECT_EQ(BytesText(37'000'000).toStdString(), "37 MB");
}

TEST_F(LinkTest, SaysHowTheLinkDoesAndWhatIsToCome) {
  head->link.health.left_bytes = 3'100'000;
  head->link.health.left_s = 41.0;
  head->link.scans = {ScanThatIs(LinkedScan::Place::kComing, "a"),
                      ScanThatIs(LinkedScan::Place::kAtHead, "b")};
  const LinkViewModel link(head, nullptr);
  EXPECT_EQ(link.Text().state.toStdString(), "well");
  EXPECT_EQ(link.Text().control.toStdString(), "You have control.");
  EXPECT_EQ(link.Text().left.toStdString(), "3.1 MB, about 40 s");
  ASSERT_EQ(link.Scans().size(), 2);
  EXPECT_EQ(link.Scans()[0].detail.toStdString(), "62 of 89 lines, 1 of 3 images, 3.1 MB to come");
  EXPECT_TRUE(link.Scans()[0].title.endsWith("coming"));
  EXPECT_EQ(link.Scans()[1].detail.toStdString(), "89 lines, 3 images, 3.1 MB to come");
}

TEST_F(LinkTest, SaysWhatCameByBurstsAndWhyNothingDoes) {
  head->link.health.down_bytes_per_s = 900.0;
  head->link.health.burst = {true, 3'100'000, 0, ""};
  EXPECT_EQ(LinkViewModel(head, nullptr).Text().rate.toStdString(), "900 B/s, 3.1 MB by bursts");
  head->link.health.burst.refused = 7;
  EXPECT_EQ(LinkViewModel(head, nullptr).Text().rate.toStdString(),
            "900 B/s, 3.1 MB by bursts (7 datagrams refused)");
  head->link.health.burst.trouble = "this head sends no bursts";
  const LinkViewModel link(head, nullptr);
  EXPECT_EQ(link.Text().rate.toStdString(), "900 B/s, no bursts");
  EXPECT_EQ(link.Text().trouble.toStdString(), "this head sends no bursts");
}

TEST_F(LinkTest, ALostLinkSaysForHowLongAndWhatToDo) {
  head->link.health.connected = false;
  head->link.health.age_s = 75.0;
  head->link.health.trouble = "is foresight-head running there?";
  const LinkViewModel link(head, nullptr);
  EXPECT_EQ(link.Text().state.toStdString(), "lost");
  EXPECT_EQ(link.Text().last_word.toStdString(), "1 min ago");
  EXPECT_EQ(link.Text().trouble.toStdString(), "is foresight-head running there?");
  EXPECT_FALSE(link.WhyNotGive().isEmpty());
}

/// What the operator sees of a head at the far end of a link.
struct HeadOverALink : LinkTest {
  HeadOverALink() {
    head->SetState(HeadState::kSweeping);
    model.Poll();
    QObject::connect(&model, &HeadViewModel::noticed, &log, &LogModel::add);
    QObject::connect(&model, &HeadViewModel::settled, &log, &LogModel::close);
  }
  void FallSilent(double age_s) {
    head->link.health.connected = false;
    head->link.health.age_s = age_s;
    model.Poll();
  }
  std::string Text() const { return model.Answers().Text().toStdString(); }
  std::string Top() const { return log.Top() ? log.Top()->notice.what.toStdString() : ""; }

  HeadViewModel model{head};
  LogModel log;
};

TEST_F(HeadOverALink, OnlyTheHeadSaysThatItStopped) {
  head->link.health.stop = StopAnswer::kWaiting;
  model.stop();
  EXPECT_TRUE(model.StopLatched());
  EXPECT_EQ(Text(), "STOP sent, not confirmed");
  EXPECT_EQ(Top(), "STOP was sent and is not confirmed.");
  head->SetState(HeadState::kReady);
  model.Poll();
  EXPECT_EQ(Text(), "STOP sent, not confirmed") << "that may be from before";
  head->SetState(HeadState::kSweeping);
  head->link.health.stop = StopAnswer::kObeyed;
  model.Poll();
  EXPECT_EQ(Text(), "STOP answered, head still sweeping");
  head->SetState(HeadState::kReady);
  model.Poll();
  EXPECT_EQ(Text(), "Head: STOPPED");
  EXPECT_EQ(Top(), "The head's motor was told to stop.");
  EXPECT_EQ(log.Open(), 1) << "that it was not confirmed no longer holds";
}

TEST_F(HeadOverALink, AStopWithoutAnAnswerOrWithARefusalIsNeverCalledDone) {
  for (const StopAnswer answer : {StopAnswer::kUnknown, StopAnswer::kRefused}) {
    head->link.health.stop = answer;
    head->SetState(HeadState::kReady);
    model.stop();
    EXPECT_EQ(Text().find("STOPPED"), std::string::npos) << Text();
    EXPECT_EQ(log.Top()->notice.level, Notice::Level::kError);
    EXPECT_TRUE(log.Top()->notice.next.startsWith("Take the head as moving."));
  }
}

TEST_F(HeadOverALink, AHeadInFaultOrNotConnectedIsNeverCalledStopped) {
  head->link.health.stop = StopAnswer::kObeyed;
  model.stop();
  head->SetFault("the motor does not answer");
  model.Poll();
  EXPECT_FALSE(model.Answers().StopConfirmed());
  EXPECT_EQ(Text(), "STOP answered, the head is in fault: see that it stands");
  head->SetState(HeadState::kDisconnected);
  model.Poll();
  EXPECT_EQ(Text(), "STOP answered, the head is not connected: see that it stands");
}

TEST(HeadInThisProcess, InFaultItIsNotCalledStoppedEither) {
  const auto head = std::make_shared<FakeHead>(DefaultSensorRig());
  HeadViewModel model(head);
  head->SetFault("the motor does not answer");
  model.stop();
  EXPECT_EQ(model.Answers().Text().toStdString(),
            "STOP answered, the head is in fault: see that it stands");
  head->SetState(HeadState::kReady);
  model.Poll();
  EXPECT_EQ(model.Answers().Text().toStdString(), "Head: STOPPED");
}

TEST(HeadInThisProcess, WhileItStillMovesItIsNotCalledStopped) {
  const auto head = std::make_shared<FakeHead>(DefaultSensorRig());
  HeadViewModel model(head);
  head->SetState(HeadState::kSweeping);
  model.stop();
  EXPECT_FALSE(model.Answers().StopConfirmed());
  EXPECT_EQ(model.Answers().Text().toStdString(), "STOP answered, head still sweeping");
  head->SetState(HeadState::kReady);
  model.Poll();
  EXPECT_EQ(model.Answers().Text().toStdString(), "Head: STOPPED");
}

TEST_F(HeadOverALink, AnAbortThatEndsInAFaultAsksToSeeThatTheHeadStands) {
  FallSilent(5.0);
  model.abort();
  head->link.health.connected = true;
  head->SetFault("the motor does not answer");
  model.Poll();
  EXPECT_EQ(Top(), "The scan was ended, and the head is in fault.");
  EXPECT_TRUE(log.Top()->notice.next.startsWith("See that it stands"));
}

TEST_F(HeadOverALink, AnAbortThatTheHeadRefusesIsToldWithItsReasonUntilTheSweepIsOver) {
  FallSilent(5.0);
  model.abort();
  head->link.health.connected = true;
  head->link.health.end_scan = StopAnswer::kRefused;
  head->link.health.end_scan_refusal = "anna does not have control: ben has it";
  head->SetState(HeadState::kSweeping);
  model.Poll();
  EXPECT_EQ(Top(), "The head refused Abort: anna does not have control: ben has it");
  head->SetState(HeadState::kReady);
  model.Poll();
  EXPECT_EQ(Top(), "");
}

TEST_F(HeadOverALink, ASweepOfAnotherOperatorIsNotOursAlsoWhileOurScanStillComes) {
  EXPECT_TRUE(model.MovesForUs()) << "this station has control";
  head->link.health.has_control = false;
  model.Poll();
  EXPECT_FALSE(model.MovesForUs());
  model.StopForGood();
  EXPECT_FALSE(head->Stopped());
  head->link.health.has_control = true;
  head->SetState(HeadState::kReady);
  model.Poll();
  model.scan();
  head->link.health.has_control = false;
  head->Deliver(WallAndValveScan({}), 20);
  model.Poll();
  EXPECT_TRUE(model.MovesForUs()) << "it was started here";
  head->SetState(HeadState::kReady);
  model.Poll();
  ASSERT_TRUE(model.Receiving());
  head->SetState(HeadState::kSweeping);
  model.Poll();
  EXPECT_FALSE(model.MovesForUs());
}

TEST_F(HeadOverALink, ASilentHeadIsNotShownAsIfItsLastWordWereCurrent) {
  FallSilent(12.3);
  EXPECT_EQ(Text(), "Head: no word for 12 s (was sweeping)");
  for (int device = 0; device < 3; ++device)
    EXPECT_EQ(model.Devices()[device].lamp, DeviceRow::Lamp::kIdle) << device;
  EXPECT_EQ(Top(), "The link is lost: no word from the head.");
  EXPECT_TRUE(log.Top()->notice.next.contains("foresight-head runs at robot:47130"));
  EXPECT_EQ(model.WhyNoHome().toStdString(),
            "The link is lost. Wait until the head is heard again.");
  head->link.health.connected = true;
  model.Poll();
  EXPECT_EQ(Text(), "Head: sweeping");
  EXPECT_EQ(Top(), "") << "it is over";
}

TEST_F(HeadOverALink, AnAbortThatTheHeadDoesNotAnswerIsSaidToBeOpen) {
  FallSilent(5.0);
  EXPECT_TRUE(model.CanAbort());
  model.abort();
  head->SetState(HeadState::kSweeping);  // for all that is known here
  EXPECT_EQ(Top(), "Abort was sent and is not confirmed.");
  head->link.health.connected = true;
  head->SetState(HeadState::kReady);
  model.Poll();
  EXPECT_EQ(Top(), "");
}

TEST_F(LinkTest, TheOrderOfScansIsTheOperators) {
  LinkViewModel link(head, nullptr);
  link.BringFirst("b");
  link.Pause("a");
  link.Bring("c");
  EXPECT_EQ(head->link.Asked(), (std::vector<std::string>{"first b", "pause a", "fetch c"}));
}

TEST_F(LinkTest, AScanThatHasComeIsToldOnce) {
  head->link.scans = {ScanThatIs(LinkedScan::Place::kComing, "a")};
  LinkViewModel link(head, nullptr);
  int arrived = 0;
  QObject::connect(&link, &LinkViewModel::scanArrived, [&] { ++arrived; });
  link.Poll();
  EXPECT_EQ(arrived, 0);
  head->link.scans[0].place = LinkedScan::Place::kHere;
  link.Poll();
  link.Poll();
  EXPECT_EQ(arrived, 1);
}

TEST_F(LinkTest, ControlIsGivenByNameAndARefusalIsSaid) {
  LinkViewModel link(head, nullptr);
  EXPECT_FALSE(link.WhyNotTake().isEmpty()) << "we have it";
  link.GiveControl(" bert ");
  EXPECT_TRUE(WaitFor([&] { return head->link.Asked() == std::vector<std::string>{"give bert"}; }));
  EXPECT_TRUE(WaitFor([&] { return link.WhyNotGive().isEmpty(); }));
  QString said;
  QObject::connect(&link, &LinkViewModel::noticed,
                   [&](const Notice& notice) { said = notice.what + notice.next; });
  head->link.health.has_control = false;
  head->link.health.holder = "bert";
  head->link.control = Fail(ErrorCode::kState, "robot: bert has control");
  link.Poll();
  EXPECT_EQ(link.Text().control.toStdString(), "bert has control.");
  link.takeControl();
  EXPECT_TRUE(WaitFor([&] { return said.contains("bert has control"); })) << said.toStdString();
}

TEST_F(LinkTest, AnObserverIsToldWhyThereIsNoControl) {
  head->link.may_operate = false;
  head->link.health.has_control = false;
  const LinkViewModel link(head, nullptr);
  EXPECT_TRUE(link.WhyNotTake().contains("observer"));
}

// What of a scan is here is shown, and the next scan need not wait for the rest.

TEST_F(LinkTest, WhatCameBehindAGapIsShownAndReplacedByTheWhole) {
  HeadViewModel model(head);
  SessionModel session(SessionMode::kSimulation);
  const ScanFlow flow(&model, &session);
  const Scan whole = WallAndValveScan({});
  model.scan();
  ASSERT_TRUE(session.ExpectsScan());
  Scan part = whole;
  part.state = ScanState::kRunning;
  part.lines = {};
  for (std::size_t i = 20; i < 30; ++i) part.lines.push_back(whole.lines[i]);
  auto early = std::make_shared<EarlyScan>();
  early->lines = 10;
  early->scan = std::make_shared<const Scan>(part);
  head->link.early = early;
  model.Poll();
  ASSERT_TRUE(WaitFor([&] { return session.Cloud() != nullptr; }));
  EXPECT_EQ(session.Cloud()->lines, 10);
  EXPECT_EQ(session.CurrentScan(), nullptr) << "it is not all there";
  EXPECT_NE(session.CurrentImage(), nullptr);
  head->Deliver(whole, whole.lines.size());
  head->Finish(whole, ScanState::kComplete);
  head->link.early.reset();
  model.Poll();
  ASSERT_NE(session.CurrentScan(), nullptr);
  EXPECT_EQ(session.CurrentScan()->lines.size(), whole.lines.size());
}

TEST_F(LinkTest, ACoarseCloudIsShownBeforeAnyLineIsHere) {
  HeadViewModel model(head);
  SessionModel session(SessionMode::kSimulation);
  const ScanFlow flow(&model, &session);
  model.scan();
  Scan header = WallAndValveScan({});
  auto cloud = RegisterScan(header, {}).value();
  header.lines = {};
  header.frames = {};
  auto early = std::make_shared<EarlyScan>();
  early->scan = std::make_shared<const Scan>(header);
  early->lines = cloud.lines;
  early->cloud = std::make_shared<const RegisteredScan>(std::move(cloud));
  head->link.early = early;
  for (int poll = 0; poll < 3 && !session.Cloud(); ++poll) model.Poll();
  EXPECT_EQ(session.Cloud(), early->cloud);
}

TEST_F(LinkTest, TheNextScanMayStartWhileTheLastOneStillComes) {
  HeadViewModel model(head);
  const Scan whole = WallAndValveScan({});
  model.scan();
  head->Deliver(whole, 20);
  model.Poll();
  EXPECT_FALSE(model.Receiving());
  EXPECT_FALSE(model.CanScan()) << "it sweeps";
  head->SetState(HeadState::kReady);  // the sweep is over, the rest is at the head
  model.Poll();
  EXPECT_TRUE(model.Receiving());
  EXPECT_TRUE(model.CanScan()) << model.WhyNoScan().toStdString();
  int started = 0;
  QObject::connect(&model, &HeadViewModel::scanStarted, [&] { ++started; });
  model.scan();
  EXPECT_EQ(started, 1);
  EXPECT_FALSE(model.Receiving());
  EXPECT_TRUE(model.Scanning());
}

// To the robot.

struct SendPoseTest : LinkTest {
  SendPoseTest() {
    Scan scan = WallAndValveScan({});
    scan.uuid = "0c2f1a3e-0000-4000-8000-000000000001";
    scan.simulated = true;
    session.SetScan(std::make_shared<const Scan>(scan));
    ValveDetection valve;
    valve.verdict = {VerdictLevel::kConfirmed, 0.997, "All agree.", {}};
    valve.best.base_from_object = SyntheticValvePose();
    valve.best.model = SyntheticValve();
    valve.covariance = PoseCovariance::Identity() * 1e-6;
    valve.alternatives = {valve.best};
    FoundObject object;
    object.detection = valve;
    object.rig = scan.rig;
    object.scan_uuid = scan.uuid;
    session.AddObject(object);
  }
  bool Sent(std::size_t count = 1) {
    return WaitFor([&] { return head->link.Asked().size() == count; }) &&
           WaitFor([&] { return session.Selected()->robot != "asked"; });
  }
  PoseMessage Line(std::size_t at) {
    return PoseMessageFromJson(head->link.Asked().at(at).substr(std::string("pose ").size()))
        .value();
  }
  SessionModel session{SessionMode::kSimulation};
  SendPoseModel model{head, &session};
};

TEST_F(SendPoseTest, OnlyWhatWasAcceptedGoes) {
  EXPECT_TRUE(model.WhyNot().contains("Accept the object first")) << model.WhyNot().toStdString();
  model.send();
  EXPECT_TRUE(head->link.Asked().empty());
  session.Decide(Decision::kAccepted);
  ASSERT_TRUE(model.WhyNot().isEmpty()) << model.WhyNot().toStdString();
  std::vector<ObjectEvent> events;
  QObject::connect(&session, &SessionModel::objectTouched,
                   [&](const ObjectEvent& event) { events.push_back(event); });
  model.send();
  ASSERT_TRUE(Sent());
  const PoseMessage line = Line(0);
  EXPECT_EQ(line.detection_uuid, session.Selected()->uuid);
  EXPECT_EQ(line.sending, 1);
  EXPECT_EQ(line.decision, Decision::kAccepted);
  EXPECT_EQ(line.origin, PoseMessage::Origin::kLive);
  EXPECT_TRUE(line.simulated);
  EXPECT_EQ(line.scan_uuid, session.CurrentScan()->uuid);
  EXPECT_EQ(line.rig_id, RigId(session.CurrentScan()->rig));
  EXPECT_EQ(session.Selected()->robot.toStdString(), "accepted");
  ASSERT_EQ(events.size(), 1u) << "the mission keeps that it was sent";
  EXPECT_EQ(events[0].action, DetectionEvent::Action::kSent);
  model.send();
  ASSERT_TRUE(Sent(2));
  EXPECT_EQ(Line(1).sending, 2);
}

TEST_F(SendPoseTest, TheRobotsRefusalIsShownWithItsReason) {
  session.Decide(Decision::kAccepted);
  head->link.answer = RobotAnswer{RobotAnswer::Kind::kRefused, "out of reach: 2.41 m"};
  model.send();
  ASSERT_TRUE(Sent());
  EXPECT_EQ(session.Selected()->robot.toStdString(), "refused: out of reach: 2.41 m");
}

TEST_F(SendPoseTest, WithoutAnAnswerTheSameLineIsSentAgain) {
  session.Decide(Decision::kAccepted);
  head->link.answer = Fail(ErrorCode::kDevice, "robot: no connection");
  model.send();
  ASSERT_TRUE(Sent());
  EXPECT_TRUE(session.Selected()->robot.startsWith("not known"));
  head->link.answer = RobotAnswer{RobotAnswer::Kind::kAccepted, ""};
  ASSERT_TRUE(WaitFor([&] { return model.WhyNot().isEmpty(); }));
  model.send();
  ASSERT_TRUE(Sent(2));
  EXPECT_EQ(Line(0).Id(), Line(1).Id());
}

TEST_F(SendPoseTest, AnAlternativeAnEarlierScanAndALostLinkAreNotSent) {
  session.nextCandidate();
  session.Decide(Decision::kAccepted);
  EXPECT_TRUE(model.WhyNot().contains("alternative")) << model.WhyNot().toStdString();
  session.previousCandidate();
  EXPECT_TRUE(model.WhyNot().contains("another answer")) << model.WhyNot().toStdString();
  session.Decide(Decision::kAccepted);
  EXPECT_TRUE(model.WhyNot().isEmpty()) << model.WhyNot().toStdString();
  head->link.health.connected = false;
  EXPECT_TRUE(model.WhyNot().contains("link is lost"));
  head->link.health.connected = true;
  head->link.health.has_control = false;
  EXPECT_TRUE(model.WhyNot().contains("control"));
  Scan other = *session.CurrentScan();
  other.uuid = "0c2f1a3e-0000-4000-8000-000000000002";
  session.SetScan(std::make_shared<const Scan>(other));
  EXPECT_TRUE(model.WhyNot().contains("earlier scan")) << model.WhyNot().toStdString();
}

TEST_F(SendPoseTest, AnUnsureVerdictIsNotSent) {
  FoundObject object = *session.Selected();
  object.uuid = NewUuid();
  std::get<ValveDetection>(object.detection).verdict.level = VerdictLevel::kUnsure;
  session.AddObject(object);
  session.Decide(Decision::kAccepted);
  EXPECT_TRUE(model.WhyNot().contains("UNSURE")) << model.WhyNot().toStdString();
}

}  // namespace
}  // namespace foresight
