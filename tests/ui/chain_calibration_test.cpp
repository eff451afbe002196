#include "ui/viewmodels/chain_calibration_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QCoreApplication>
#include <QDir>
#include <QFile>
#include <QTemporaryDir>

#include "core/geometry/angles.h"
#include "core/sensor/rig_id.h"
#include "tests/ui/board_pictures.h"
#include "tests/ui/fake_head.h"
#include "tests/ui/simulated_session.h"
#include "tests/ui/wait_for.h"

namespace foresight {
namespace {

using testing::HasSubstr;
using CaptureKind = SessionCapture::Kind;

struct ChainCalibration : testing::Test {
  QTemporaryDir folder;
  QString sessions = folder.filePath("sessions");
  QString simulated = sessions + "/head-2026-01-01-000000";
  std::shared_ptr<FakeHead> head = std::make_shared<FakeHead>(DefaultSensorRig());
  TaskQueue tasks;
  HeadViewModel head_model{head};
  SessionModel session{SessionMode::kSimulation, &tasks};
  ChainCalibrationModel model{&head_model, &session, sessions};
  std::vector<Notice> notices;

  ChainCalibration() {
    QObject::connect(&session, &SessionModel::noticed,
                     [this](const Notice& notice) { notices.push_back(notice); });
  }
  static bool Settled(const ChainCalibrationModel& model) {
    return WaitFor([&] { return !model.Busy(); }, 60'000);
  }
  bool Settled() const { return Settled(model); }
  bool Open(int poses = 4) {
    QDir().mkpath(sessions);
    WriteSmallSession(simulated, poses);
    model.OpenSession(simulated);
    return Settled();
  }
  bool Solve() {
    model.solve();
    return Settled();
  }
  int Lamps(StopLamp::State state) const {
    int count = 0;
    for (const StandPlaceRow& row : model.Places())
      for (const StopLamp& lamp : row.stops) count += lamp.state == state ? 1 : 0;
    return count;
  }
};

TEST_F(ChainCalibration, ASessionIsOpenedShownAndSolvedAsTheCommandLineDoes) {
  ASSERT_TRUE(Open());
  ASSERT_EQ(model.Places().size(), 4u);
  EXPECT_EQ(model.BoardImages().size(), 8u);
  EXPECT_GT(Lamps(StopLamp::State::kBothBoards), 8);
  EXPECT_EQ(model.Solution(), nullptr) << "nothing is solved before it is asked for";
  EXPECT_FALSE(model.WhyNotSaveRig().isEmpty());
  ASSERT_TRUE(Solve());
  ASSERT_NE(model.Solution(), nullptr) << model.StateText().toStdString();
  EXPECT_TRUE(model.SolutionIsCurrent());
  EXPECT_GE(model.Verdict().size(), 6u);
  EXPECT_FALSE(model.Weakest().isEmpty());

  const auto read = ReadCalibrationSession(simulated.toStdString(), {});
  ASSERT_TRUE(read) << read.error().message;
  ChainCalibrationOptions options;
  options.noise_from_residuals = true;
  const auto again = CalibrateChain(*read, options, {});
  ASSERT_TRUE(again) << again.error().message;
  // Ceres orders unknowns by where they lie in memory: the last digits differ.
  EXPECT_NEAR(model.Solution()->found.rig.camera.fx, again->rig.camera.fx, 1e-4);
  EXPECT_NEAR(model.Solution()->found.mean_error_px, again->mean_error_px, 1e-6);
  EXPECT_TRUE(notices.empty());
}

TEST_F(ChainCalibration, APlaceThatIsLeftOutIsSolvedWithoutAndUndoTakesItInAgain) {
  ASSERT_TRUE(Open());
  ASSERT_TRUE(Solve());
  ASSERT_TRUE(model.Solution()) << model.StateText().toStdString();
  const std::size_t boards = model.Solution()->boards.size();
  model.SetExcluded({CaptureKind::kPose, 3, -1}, true);
  ASSERT_TRUE(Settled());
  EXPECT_TRUE(model.Places()[3].excluded);
  // Without the fourth place a stop may be loose; then the reason is told and nothing is kept.
  if (model.Solution())
    EXPECT_EQ(model.Solution()->boards.size(), boards - 2);
  else
    EXPECT_FALSE(model.StateText().isEmpty());
  session.Undo()->undo();
  ASSERT_TRUE(Settled());
  EXPECT_FALSE(model.Places()[3].excluded);
  ASSERT_TRUE(model.Solution()) << model.StateText().toStdString();
  EXPECT_EQ(model.Solution()->boards.size(), boards);
}

TEST_F(ChainCalibration, AnImageThatIsLeftOutIsStillLeftOutAfterACrash) {
  ASSERT_TRUE(Open());
  model.SetExcluded({CaptureKind::kIntrinsicImage, -1, 2}, true);
  ASSERT_TRUE(Settled());
  EXPECT_EQ(model.BoardImages()[2].state, BoardImageRow::State::kExcluded);
  ChainCalibrationModel again(&head_model, &session, sessions);
  ASSERT_EQ(again.LastSession(), simulated);
  again.OpenSession(again.LastSession());
  ASSERT_TRUE(Settled(again));
  EXPECT_EQ(again.BoardImages()[2].state, BoardImageRow::State::kExcluded);
  EXPECT_EQ(again.Places().size(), 4u);
}

TEST_F(ChainCalibration, TooFewPlacesAreToldAndNotSolved) {
  ASSERT_TRUE(Open(2));
  EXPECT_THAT(model.WhyNotSolve().toStdString(), HasSubstr("there are 2"));
  EXPECT_THAT(model.Next().toStdString(), HasSubstr("next: "));
  ASSERT_TRUE(Solve());
  EXPECT_EQ(model.Solution(), nullptr);
  EXPECT_THAT(model.StateText().toStdString(), HasSubstr("there are 2"));
}

TEST_F(ChainCalibration, WhatIsCancelledSaysSoAndCanBeSolvedAgain) {
  ASSERT_TRUE(Open());
  model.solve();
  ASSERT_TRUE(WaitFor([&] { return model.Solving(); }));
  model.cancel();
  ASSERT_TRUE(Settled());
  EXPECT_EQ(model.Solution(), nullptr);
  EXPECT_THAT(model.StateText().toStdString(), HasSubstr("cancelled"));
  ASSERT_TRUE(Solve());
  EXPECT_NE(model.Solution(), nullptr);
}

TEST_F(ChainCalibration, TheLidarsPointsOfASelectedStopAreThere) {
  ASSERT_TRUE(Open());
  ASSERT_TRUE(Solve());
  ASSERT_TRUE(model.Solution());
  std::size_t points = 0;
  for (int place = 0; place < 4; ++place)
    for (int stop = 0; stop < static_cast<int>(model.Places()[0].stops.size()); ++stop) {
      model.Select(place, stop);
      points += model.SelectedPoints().size();
    }
  EXPECT_EQ(points, model.Solution()->points.size()) << "each point is of one stop";
}

TEST_F(ChainCalibration, TheRigIsAChildOfTheOneInForceAndKeepsItsPlaceOnTheRobot) {
  ASSERT_TRUE(Open());
  ASSERT_TRUE(Solve());
  ASSERT_TRUE(model.WhyNotSaveRig().isEmpty()) << model.WhyNotSaveRig().toStdString();
  const QString file = folder.filePath("new.yaml");
  model.SaveRig(file);
  ASSERT_TRUE(WaitFor([&] { return !model.Rig()->Busy(); }));
  const auto saved = LoadSensorRig(file.toStdString());
  ASSERT_TRUE(saved) << saved.error().message;
  EXPECT_EQ(saved->parent_id, RigId(head->Rig()));
  EXPECT_EQ(saved->camera, model.Solution()->found.rig.camera);
  EXPECT_EQ(saved->robot_from_base.Matrix(), head->Rig().robot_from_base.Matrix());
}

/// Small, so that a look for boards that are not there takes no time.
SensorRig ChainRigOfSmallCamera() {
  SensorRig rig = DefaultSensorRig();
  rig.camera = SmallCamera();
  return rig;
}

StopCapture DarkCapture(double angle_rad) {
  const SensorRig rig = ChainRigOfSmallCamera();
  StopCapture capture;
  capture.target_rad = angle_rad;
  capture.position = {1.0, angle_rad + 1e-5};
  capture.image.emplace();
  capture.image->image = ColorImage(rig.camera.width, rig.camera.height, {10, 10, 10});
  LidarLine line;
  line.range_mm.assign(static_cast<std::size_t>(rig.lidar.beams), 2000);
  capture.lines = {line, line};
  return capture;
}

TEST_F(ChainCalibration, CapturesAreOnTheDiskBeforeAnythingIsComputedAndGoOnAfterACrash) {
  ASSERT_TRUE(head->SetRig(ChainRigOfSmallCamera()));
  StandPlan plan;
  plan.first_deg = 0.0;
  plan.last_deg = 10.0;
  model.Recorder()->SetPlan(plan);
  model.Recorder()->captureStops();
  ASSERT_EQ(head->stop_plan.angles_rad.size(), 2u);
  EXPECT_FALSE(model.Recorder()->WhyNotCapture().isEmpty());
  // The second stop never comes.
  head->stop_plan.angles_rad.pop_back();
  head->DeliverStops(DarkCapture, ScanState::kInterrupted, "the motor is stuck");
  head_model.Poll();
  ASSERT_TRUE(Settled());
  ASSERT_EQ(notices.size(), 1u);
  EXPECT_THAT(notices[0].what.toStdString(), HasSubstr("the motor is stuck"));
  ASSERT_EQ(model.Places().size(), 1u);
  ASSERT_EQ(model.Places()[0].stops.size(), 2u);
  EXPECT_EQ(model.Places()[0].stops[0].state, StopLamp::State::kNoBoard);
  EXPECT_TRUE(model.Places()[0].stops[0].has_lines);
  EXPECT_EQ(model.Places()[0].stops[1].state, StopLamp::State::kWaiting);

  ChainCalibrationModel again(&head_model, &session, sessions);
  ASSERT_EQ(again.LastSession(), model.Folder());
  again.OpenSession(again.LastSession());
  ASSERT_TRUE(Settled(again));
  again.Recorder()->SetPlan(plan);
  EXPECT_THAT(again.Recorder()->WhyNotCapture().toStdString(), HasSubstr("still at 'pose 1'?"))
      << "nobody but the operator knows";
  again.Recorder()->samePlace();
  again.Recorder()->captureStops();
  ASSERT_EQ(head->stop_plan.angles_rad.size(), 1u) << "only what is missing";
  EXPECT_NEAR(head->stop_plan.angles_rad[0], RadiansFromDegrees(10.0), 1e-9);
  head->DeliverStops(DarkCapture);
  head_model.Poll();
  ASSERT_TRUE(Settled(again));
  EXPECT_EQ(again.Places()[0].stops[1].state, StopLamp::State::kNoBoard);
}

TEST_F(ChainCalibration, AnOpenedSessionIsAddedToAtANewPlaceOnceTheOperatorSaysSo) {
  ASSERT_TRUE(head->SetRig(ChainRigOfSmallCamera()));
  CalibrationRecorder* recorder = model.Recorder();
  recorder->captureStops();
  head->DeliverStops(DarkCapture);
  head_model.Poll();
  ASSERT_TRUE(Settled());
  const QString first = model.Folder();
  const std::size_t stops = recorder->Index().poses[0].stops.size();
  model.startNew();
  model.OpenSession(first);
  ASSERT_TRUE(Settled());
  EXPECT_FALSE(recorder->WhyNotSweep().isEmpty());
  recorder->newPlace();
  recorder->newPlace();  // a double click
  ASSERT_TRUE(Settled());
  recorder->captureStops();
  head->DeliverStops(DarkCapture);
  head_model.Poll();
  ASSERT_TRUE(Settled());
  ASSERT_EQ(recorder->Index().poses.size(), 2u);
  EXPECT_EQ(recorder->Index().poses[0].stops.size(), stops);
  EXPECT_EQ(recorder->Index().poses[1].stops.size(), stops);
}

TEST_F(ChainCalibration, AHeadThatRefusesTheStopsLeavesNoEmptyPlace) {
  ASSERT_TRUE(head->SetRig(ChainRigOfSmallCamera()));
  head->SetState(HeadState::kSweeping);  // the window has not heard of it yet
  model.Recorder()->captureStops();
  ASSERT_TRUE(WaitFor([&] { return !model.Recorder()->Writing(); }));
  EXPECT_TRUE(model.Recorder()->Index().poses.empty());
  EXPECT_TRUE(model.Folder().isEmpty());
  EXPECT_EQ(notices.size(), 1u);
}

TEST_F(ChainCalibration, UndoOfAnExclusionGoesBackAlsoWhereTheStopWasCapturedAgain) {
  ASSERT_TRUE(head->SetRig(ChainRigOfSmallCamera()));
  StandPlan plan;
  plan.first_deg = plan.last_deg = 0.0;
  model.Recorder()->SetPlan(plan);
  const auto deliver = [&] {
    head->DeliverStops(DarkCapture);
    head_model.Poll();
    return Settled();
  };
  const auto excluded = [&] {
    std::vector<bool> flags;
    for (const SessionStopFiles& stop : model.Recorder()->Index().poses[0].stops)
      flags.push_back(stop.excluded);
    return flags;
  };
  model.Recorder()->captureStops();
  ASSERT_TRUE(deliver());
  model.SetExcluded({CaptureKind::kStop, 0, 0}, true);
  ASSERT_TRUE(Settled());
  model.Recorder()->CaptureStopAgain(0.0);
  ASSERT_TRUE(deliver());
  ASSERT_THAT(excluded(), testing::ElementsAre(true, false));
  session.Undo()->undo();
  ASSERT_TRUE(Settled());
  EXPECT_THAT(excluded(), testing::ElementsAre(false, true));
  session.Undo()->redo();
  ASSERT_TRUE(Settled());
  EXPECT_THAT(excluded(), testing::ElementsAre(true, false)) << "one of them is always used";
  session.Undo()->undo();
  ASSERT_TRUE(Settled());
  EXPECT_THAT(excluded(), testing::ElementsAre(false, true));
}

TEST_F(ChainCalibration, AHeadThatWasStoppedCapturesNothing) {
  head_model.stop();
  model.Recorder()->captureStops();
  ASSERT_FALSE(model.Recorder()->WhyNotCapture().isEmpty());
  EXPECT_TRUE(head->stop_plan.angles_rad.empty());
}

TEST_F(ChainCalibration, ASweepGoesThereAndBackAndIsKeptWithThePlace) {
  ASSERT_TRUE(head->SetRig(ChainRigOfSmallCamera()));
  StandPlan plan;
  plan.first_deg = -1.0;
  plan.last_deg = 1.0;
  plan.step_deg = 1.0;
  model.Recorder()->SetPlan(plan);
  EXPECT_FALSE(model.Recorder()->WhyNotSweep().isEmpty()) << "there is no place yet";
  model.Recorder()->captureStops();
  head->DeliverStops(DarkCapture);
  head_model.Poll();
  ASSERT_TRUE(Settled());
  model.Recorder()->captureSweep();
  EXPECT_EQ(head->LastPlan().passes, 2);
  Scan scan;
  scan.rig = DefaultSensorRig();
  scan.lines = DarkCapture(0.0).lines;
  scan.track = *MotorTrack::FromSamples({{0.0, -0.01}, {1.0, 0.01}});
  head->Deliver(scan, scan.lines.size());
  head->Finish(scan, ScanState::kComplete);
  head_model.Poll();
  ASSERT_TRUE(Settled());
  EXPECT_EQ(model.Places()[0].sweep, StandPlaceRow::Sweep::kThere);
  EXPECT_EQ(session.CurrentScan(), nullptr) << "it is no scan of the mission";
}

/// Sharp edges and good light, and no board.
StopCapture StripedCapture(double angle_rad) {
  StopCapture capture = DarkCapture(angle_rad);
  ColorImage& image = capture.image->image;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      if (x / 16 % 2 == 0) image(x, y) = {200, 200, 200};
  return capture;
}

TEST_F(ChainCalibration, BoardsThatAreInNoImageAreCalledWrong) {
  ASSERT_TRUE(head->SetRig(ChainRigOfSmallCamera()));
  StandPlan plan;
  plan.first_deg = 0.0;
  plan.last_deg = 20.0;
  model.Recorder()->SetPlan(plan);
  model.Recorder()->captureStops();
  head->DeliverStops(StripedCapture);
  head_model.Poll();
  ASSERT_TRUE(Settled());
  EXPECT_THAT(model.StateText().toStdString(),
              HasSubstr("None of 3 images shows a checkerboard with 9 x 6 inner corners or"));
}

TEST_F(ChainCalibration, DarkImagesAreNotBlamedOnTheBoards) {
  ASSERT_TRUE(head->SetRig(ChainRigOfSmallCamera()));
  StandPlan plan;
  plan.first_deg = 0.0;
  plan.last_deg = 20.0;
  model.Recorder()->SetPlan(plan);
  model.Recorder()->captureStops();
  head->DeliverStops(DarkCapture);
  head_model.Poll();
  ASSERT_TRUE(Settled());
  const std::string state = model.StateText().toStdString();
  EXPECT_THAT(state, HasSubstr("3 of them cannot be used, such as: underexposed"));
  EXPECT_THAT(state, testing::Not(HasSubstr("step 1")));
}

/// Three places: the single board, then the mount twice.
class FakeStand : public MovingStand {
 public:
  explicit FakeStand(BoardMount mount = UsualBoardMount()) : mount_(std::move(mount)) {}

  const BoardMount& Mount() const override { return mount_; }
  const CalibrationBoard& SingleBoard() const override { return mount_.a; }
  const std::vector<Place>& Places() const override { return places_; }
  int At() const override { return at; }
  void MoveTo(int place) override {
    asked = place;
    if (!takes_time) Arrive();
  }
  bool Moving() const override { return asked.has_value(); }
  std::string Trouble() const override { return trouble; }
  void Arrive() { at = *std::exchange(asked, std::nullopt); }
  void Refuse(const std::string& why) {
    asked.reset();
    trouble = why;
  }

  int at = 0;
  bool takes_time = false;  ///< as at the far end of a link
  std::optional<int> asked;
  std::string trouble;

 private:
  BoardMount mount_;
  std::vector<Place> places_ = {{"view", false}, {"upright", true}, {"level", true}};
};

struct MovingStandCalibration : ChainCalibration {
  std::shared_ptr<FakeStand> stand = std::make_shared<FakeStand>();
  ChainCalibrationModel moving{&head_model, &session, folder.filePath("moving"), stand};
  CalibrationRecorder* recorder = moving.Recorder();

  MovingStandCalibration() {
    EXPECT_TRUE(head->SetRig(ChainRigOfSmallCamera()));
    StandPlan plan;
    plan.first_deg = 0.0;
    plan.last_deg = 10.0;
    recorder->SetPlan(plan);
  }
  void DeliverSweep() {
    Scan scan;
    scan.rig = DefaultSensorRig();
    scan.lines = DarkCapture(0.0).lines;
    scan.track = *MotorTrack::FromSamples({{0.0, -0.01}, {1.0, 0.01}});
    head->Deliver(scan, scan.lines.size());
    head->Finish(scan, ScanState::kComplete);
  }
  /// The head does all that it is asked for, until the tour ends; `stops` of them complete.
  bool ServeTour(int stops = 1000) {
    return WaitFor([&] {
      if (head->WaitsForStops()) {
        const bool complete = stops-- > 0;
        head->DeliverStops(DarkCapture, complete ? ScanState::kComplete : ScanState::kInterrupted,
                           complete ? "" : "the motor is stuck");
      } else if (head->WaitsForScan()) {
        DeliverSweep();
      }
      head_model.Poll();
      return !moving.Tour()->Running();
    });
  }
};

TEST_F(MovingStandCalibration, NothingIsCapturedWhileTheStandIsOnItsWay) {
  stand->takes_time = true;
  recorder->MoveStand(1);
  EXPECT_TRUE(recorder->WhyNotCapture().contains("on its way"));
  EXPECT_TRUE(recorder->WhyNotBoardImage().contains("on its way"));
  EXPECT_TRUE(recorder->WhyNotMoveStand().contains("on its way"));
  bool changed = false;
  QObject::connect(recorder, &CalibrationRecorder::changed, recorder, [&] { changed = true; });
  stand->Arrive();
  EXPECT_TRUE(WaitFor([&] { return changed; })) << "the window looks again";
  EXPECT_TRUE(recorder->WhyNotMoveStand().isEmpty());
  EXPECT_FALSE(recorder->WhyNotCapture().contains("on its way"));
}

TEST_F(MovingStandCalibration, ATourWaitsForAStandThatTakesItsTime) {
  stand->takes_time = true;
  moving.Tour()->start();
  const bool ended = WaitFor([&] {
    if (stand->asked) stand->Arrive();
    if (head->WaitsForStops()) head->DeliverStops(DarkCapture, ScanState::kComplete, "");
    if (head->WaitsForScan()) DeliverSweep();
    head_model.Poll();
    return !moving.Tour()->Running();
  });
  ASSERT_TRUE(ended);
  EXPECT_EQ(stand->at, 2);
  ASSERT_EQ(recorder->Index().poses.size(), 2u);
  EXPECT_EQ(recorder->Index().poses[0].name, "upright");
  EXPECT_EQ(recorder->Index().poses[1].name, "level");
}

TEST_F(MovingStandCalibration, ATourEndsWhereTheStandDoesNotGo) {
  stand->takes_time = true;
  stand->at = 1;
  QString told;
  QObject::connect(&session, &SessionModel::noticed, &session,
                   [&](const Notice& notice) { told = notice.what + notice.next; });
  moving.Tour()->start();
  const bool ended = WaitFor([&] {
    if (stand->asked) stand->Refuse("the head does not answer");
    if (head->WaitsForStops()) head->DeliverStops(DarkCapture, ScanState::kComplete, "");
    if (head->WaitsForScan()) DeliverSweep();
    head_model.Poll();
    return !moving.Tour()->Running();
  });
  ASSERT_TRUE(ended);
  EXPECT_EQ(stand->at, 1);
  for (const auto& pose : recorder->Index().poses) EXPECT_NE(pose.name, "level");
  EXPECT_TRUE(told.contains("The head does not answer")) << told.toStdString();
}

TEST_F(MovingStandCalibration, ATourCapturesAllPlacesAndNamesThem) {
  EXPECT_EQ(recorder->Mount(), UsualBoardMount()) << "the stand's";
  EXPECT_FALSE(recorder->WhyNotCapture().isEmpty()) << "the stand shows the single board";
  moving.Tour()->start();
  EXPECT_FALSE(recorder->WhyNotMoveStand().isEmpty());
  ASSERT_TRUE(ServeTour());
  EXPECT_EQ(stand->at, 2);
  const SessionIndex& index = recorder->Index();
  EXPECT_EQ(index.intrinsic_views.size(), 1u);
  ASSERT_EQ(index.poses.size(), 2u);
  EXPECT_EQ(index.poses[0].name, "upright");
  EXPECT_EQ(index.poses[1].name, "level");
  for (const SessionPoseFiles& pose : index.poses) {
    EXPECT_EQ(pose.stops.size(), 2u);
    EXPECT_EQ(pose.sweeps.size(), 1u);
  }
}

TEST_F(MovingStandCalibration, ATourThatIsInterruptedGoesOnWhereTheStandIs) {
  moving.Tour()->start();
  ASSERT_TRUE(ServeTour(2));  // the image and the stops of the first place
  ASSERT_EQ(notices.size(), 1u);
  EXPECT_EQ(stand->at, 2);
  moving.Tour()->start();
  ASSERT_TRUE(ServeTour());
  EXPECT_EQ(recorder->Index().intrinsic_views.size(), 1u) << "not taken once more";
  ASSERT_EQ(recorder->Index().poses.size(), 2u);
  EXPECT_EQ(recorder->Index().poses[1].sweeps.size(), 1u);
}

TEST_F(MovingStandCalibration, ANewSessionsTourBeginsAtTheFirstPlace) {
  moving.Tour()->start();
  ASSERT_TRUE(ServeTour());
  moving.startNew();
  moving.Tour()->start();
  ASSERT_TRUE(ServeTour());
  EXPECT_EQ(recorder->Index().intrinsic_views.size(), 1u);
  EXPECT_EQ(recorder->Index().poses.size(), 2u);
}

TEST_F(MovingStandCalibration, AnOpenedSessionOfAnotherPlaceIsNotAddedTo) {
  moving.Tour()->start();
  ASSERT_TRUE(ServeTour());
  ASSERT_TRUE(WaitFor([&] { return !moving.Busy(); }));
  const QString complete = moving.Folder();
  moving.startNew();
  recorder->MoveStand(1);
  moving.OpenSession(complete);
  ASSERT_TRUE(WaitFor([&] { return !moving.Busy() && !moving.Folder().isEmpty(); }));
  EXPECT_EQ(recorder->PresentPlace(), -1) << "its last place is 'level', the stand is 'upright'";
  moving.Tour()->start();
  ASSERT_TRUE(ServeTour());
  const SessionIndex& index = recorder->Index();
  ASSERT_EQ(index.poses.size(), 4u);
  EXPECT_EQ(index.poses[1].sweeps.size(), 1u) << "no sweep of another place";
  EXPECT_FALSE(index.poses[1].sweeps[0].excluded);
  EXPECT_EQ(index.poses[2].name, "upright");
}

TEST_F(MovingStandCalibration, CapturesOnTheirWayAreOfNoOtherSession) {
  recorder->MoveStand(1);
  recorder->captureStops();
  head->DeliverStops(DarkCapture);  // in the queue, not taken yet
  moving.startNew();
  QCoreApplication::processEvents();
  head_model.Poll();
  ASSERT_TRUE(WaitFor([&] { return !moving.Busy(); }));
  EXPECT_TRUE(moving.Folder().isEmpty()) << "no session begins by itself";
  EXPECT_TRUE(recorder->Index().poses.empty());
}

// A folder cannot be written to where a file is: the new place is not kept, so its stops are not.
TEST_F(MovingStandCalibration, StopsOfAPlaceThatIsNotKeptGoIntoNoOtherPlace) {
  recorder->MoveStand(1);
  recorder->captureStops();
  head->DeliverStops(DarkCapture);
  head_model.Poll();
  ASSERT_TRUE(WaitFor([&] { return recorder->WhyNotMoveStand().isEmpty(); }));
  recorder->MoveStand(2);
  const QString folder_path = moving.Folder(), hidden = folder_path + ".away";
  recorder->captureStops();  // begins the place
  ASSERT_TRUE(QDir().rename(folder_path, hidden));
  ASSERT_TRUE(WaitFor([&] { return !recorder->Writing(); }));
  ASSERT_TRUE(QDir().rename(hidden, folder_path));
  head->DeliverStops(DarkCapture);
  head_model.Poll();
  ASSERT_TRUE(WaitFor([&] { return recorder->WhyNotMoveStand().isEmpty(); }));
  EXPECT_EQ(recorder->Index().poses[0].stops.size(), 2u);
  EXPECT_FALSE(notices.empty());
}

TEST_F(MovingStandCalibration, ATourDoesNotRepeatWhatTheSessionHas) {
  moving.Tour()->start();
  ASSERT_TRUE(ServeTour());
  moving.Tour()->start();  // the stand is at the last place
  ASSERT_TRUE(ServeTour());
  EXPECT_EQ(recorder->Index().poses[1].sweeps.size(), 1u);
  recorder->MoveStand(0);
  moving.Tour()->start();
  ASSERT_TRUE(ServeTour());
  EXPECT_EQ(recorder->Index().intrinsic_views.size(), 1u) << "an image counts once in the solve";
}

TEST_F(MovingStandCalibration, ATourEndsWhereACaptureCannotBeKept) {
  moving.Tour()->start();
  ASSERT_TRUE(WaitFor([&] {
    if (head->WaitsForStops() && recorder->CapturingBoardImage()) head->DeliverStops(DarkCapture);
    head_model.Poll();
    return head->WaitsForStops() && !recorder->CapturingBoardImage() && !recorder->Writing();
  }));
  const QString hidden = moving.Folder() + ".away";
  ASSERT_TRUE(QDir().rename(moving.Folder(), hidden));
  head->DeliverStops(DarkCapture);
  ASSERT_TRUE(ServeTour());
  EXPECT_EQ(stand->at, 1) << "the tour does not go on to the next place";
  EXPECT_FALSE(notices.empty());
}

TEST_F(MovingStandCalibration, ATourWithoutStopsIsRefused) {
  StandPlan plan;
  plan.first_deg = 20.0;
  plan.last_deg = 10.0;
  recorder->SetPlan(plan);
  EXPECT_EQ(moving.Tour()->WhyNot(), "The plan has no stops.");
  moving.Tour()->start();
  EXPECT_FALSE(moving.Tour()->Running());
  EXPECT_FALSE(head->WaitsForStops());
}

TEST_F(MovingStandCalibration, ASweepThatCannotBeginSaysWhy) {
  recorder->MoveStand(1);
  recorder->captureSweep();
  ASSERT_EQ(notices.size(), 1u);
  EXPECT_THAT(notices[0].next.toStdString(), HasSubstr("Capture the stops of a place first"));
}

TEST_F(MovingStandCalibration, BoardsThatImagesDoNotTellApartAreRefusedBeforeACapture) {
  BoardMount alike = UsualBoardMount();
  alike.a.kind = alike.b->kind = CalibrationBoard::Kind::kCharuco;
  const auto two = std::make_shared<FakeStand>(alike);
  ChainCalibrationModel other{&head_model, &session, folder.filePath("alike"), two};
  two->at = 1;
  EXPECT_THAT(other.Recorder()->WhyNotCapture().toStdString(), HasSubstr("dictionary"));
  EXPECT_THAT(other.Tour()->WhyNot().toStdString(), HasSubstr("dictionary"));
  other.Recorder()->captureStops();
  other.Recorder()->captureBoardImage();
  other.Tour()->start();
  EXPECT_FALSE(head->WaitsForStops());
  EXPECT_TRUE(other.Folder().isEmpty());
}

// No folder can be made where a file is.
TEST_F(MovingStandCalibration, ASessionThatCouldNotBeMadeIsTriedAgain) {
  const QString root = folder.filePath("moving");
  QFile file(root);
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.close();
  recorder->MoveStand(1);
  recorder->captureStops();
  head->DeliverStops(DarkCapture);
  head_model.Poll();
  ASSERT_TRUE(WaitFor([&] { return recorder->WhyNotMoveStand().isEmpty(); }));
  EXPECT_FALSE(notices.empty());
  EXPECT_TRUE(moving.Folder().isEmpty());
  ASSERT_TRUE(file.remove());
  BoardMount mount = UsualBoardMount();
  mount.a.columns = 11;
  ASSERT_TRUE(moving.SetBoards(mount, mount.a));
  recorder->captureStops();
  head->DeliverStops(DarkCapture);
  head_model.Poll();
  ASSERT_TRUE(WaitFor([&] { return recorder->WhyNotMoveStand().isEmpty(); }));
  ASSERT_EQ(recorder->Index().poses.size(), 1u);
  EXPECT_EQ(recorder->Index().poses[0].stops.size(), 2u);
  EXPECT_EQ(recorder->Index().mount.a.columns, 11) << "the boards as they are now";
}

TEST_F(MovingStandCalibration, AStandThatIsMovedBeginsAPlace) {
  recorder->MoveStand(1);
  recorder->captureStops();
  head->DeliverStops(DarkCapture);
  head_model.Poll();
  ASSERT_TRUE(WaitFor([&] { return recorder->WhyNotMoveStand().isEmpty(); }));
  recorder->MoveStand(2);
  EXPECT_FALSE(recorder->WhyNotSweep().isEmpty()) << "nothing is captured here yet";
  recorder->captureStops();
  head->DeliverStops(DarkCapture);
  head_model.Poll();
  ASSERT_TRUE(WaitFor([&] { return recorder->WhyNotMoveStand().isEmpty(); }));
  ASSERT_EQ(recorder->Index().poses.size(), 2u);
  EXPECT_EQ(recorder->Index().poses[0].name, "upright");
  EXPECT_EQ(recorder->Index().poses[1].stops.size(), 2u);
}

}  // namespace
}  // namespace foresight
