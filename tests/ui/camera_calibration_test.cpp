#include "ui/viewmodels/camera_calibration_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QFile>
#include <QTemporaryDir>
#include <atomic>
#include <thread>

#include "core/sensor/rig_id.h"
#include "tests/ui/board_pictures.h"
#include "tests/ui/fake_head.h"
#include "tests/ui/synthetic_scan.h"
#include "tests/ui/wait_for.h"

namespace foresight {
namespace {

using State = CalibrationImageRow::State;
using testing::HasSubstr;

SensorRig RigOfSmallCamera() {
  SensorRig rig = DefaultSensorRig();
  rig.camera = SmallCamera();
  rig.camera.fx = rig.camera.fy = 230.0;  // what is calibrated differs from what is in force
  return rig;
}

struct CameraCalibrationTest : testing::Test {
  QTemporaryDir folder;
  QString pictures = folder.filePath("pictures");
  QString sessions = folder.filePath("sessions");
  std::shared_ptr<FakeHead> head = std::make_shared<FakeHead>(RigOfSmallCamera());
  TaskQueue tasks;
  HeadViewModel head_model{head};
  SessionModel session{SessionMode::kSimulation, &tasks};
  CameraCalibrationModel model{&head_model, &session, sessions};
  std::vector<Notice> notices;

  CameraCalibrationTest() {
    QObject::connect(&session, &SessionModel::noticed,
                     [this](const Notice& notice) { notices.push_back(notice); });
  }
  static bool Settled(const CameraCalibrationModel& model) {
    return WaitFor([&] { return !model.Busy(); }, 60'000);
  }
  bool Settled() const { return Settled(model); }
  /// Adds rendered images and waits for what comes of them.
  bool Add(int count) {
    EXPECT_TRUE(model.SetBoard(WriteBoardPictures(pictures, count)));
    model.AddFiles({pictures});
    return Settled();
  }
};

TEST_F(CameraCalibrationTest, ImagesAreRatedAsTheyComeAndGiveTheCamera) {
  ASSERT_TRUE(WritePng(folder.filePath("wall.png").toStdString(), GrayImage(480, 360, 120)));
  model.AddFiles({folder.filePath("wall.png")});
  ASSERT_TRUE(Add(8));
  ASSERT_EQ(model.Images().size(), 9u);
  EXPECT_EQ(model.Images()[0].state, State::kRejected);
  EXPECT_FALSE(model.Images()[0].reason.isEmpty());
  EXPECT_EQ(model.UsedCount(), 8) << model.StateText().toStdString();
  for (std::size_t i = 1; i < 9; ++i) {
    EXPECT_EQ(model.Images()[i].state, State::kUsed) << model.Images()[i].reason.toStdString();
    EXPECT_GT(model.Images()[i].rms_px, 0.0);
    EXPECT_LT(model.Images()[i].rms_px, 0.5) << "rendered edges are exact";
    EXPECT_GT(model.Images()[i].rating.coverage, 0.0);
    EXPECT_EQ(model.Images()[i].thumbnail.width(), 96);
  }
  ASSERT_NE(model.ChosenModel(), nullptr) << model.StateText().toStdString();
  EXPECT_TRUE(model.ResultIsCurrent());
  // Half a per cent: eight small images know the focal length to about 0.1 %.
  EXPECT_NEAR(model.ChosenModel()->camera.fx, 224.0, 0.005 * 224.0);
  EXPECT_EQ(model.ModelRows().size(), 3u);
  EXPECT_THAT(model.WhyChosen().toStdString(), HasSubstr("Chosen"));
  EXPECT_GE(model.Verdict().size(), 5u);
  EXPECT_THAT(model.Next().toStdString(), HasSubstr("next: "));
  EXPECT_TRUE(notices.empty());
  EXPECT_EQ(session.CurrentScan(), nullptr);
}

TEST_F(CameraCalibrationTest, AnImageThatIsLeftOutIsSolvedWithoutAndUndoTakesItInAgain) {
  ASSERT_TRUE(Add(5));
  ASSERT_TRUE(model.Calibration()) << model.StateText().toStdString();
  EXPECT_EQ(model.Calibration()->images_used.size(), 5u);
  model.SetExcluded(2, true);
  EXPECT_FALSE(model.ResultIsCurrent());
  ASSERT_TRUE(Settled());
  EXPECT_EQ(model.Images()[2].state, State::kExcluded);
  ASSERT_TRUE(model.Calibration());
  EXPECT_EQ(model.Calibration()->images_used.size(), 4u);
  session.Undo()->undo();
  ASSERT_TRUE(Settled());
  EXPECT_EQ(model.Images()[2].state, State::kUsed);
  EXPECT_EQ(model.Calibration()->images_used.size(), 5u);
  session.Undo()->redo();
  model.SetExcluded(3, true);
  ASSERT_TRUE(Settled());
  EXPECT_EQ(model.Calibration(), nullptr) << "three images are too few";
  EXPECT_THAT(model.StateText().toStdString(), HasSubstr("there are 3"));
}

TEST_F(CameraCalibrationTest, AfterACrashTheSessionGoesOnWithItsImages) {
  ASSERT_TRUE(Add(5));
  model.SetExcluded(0, true);
  ASSERT_TRUE(Settled());
  const double focal = model.ChosenModel() ? model.ChosenModel()->camera.fx : 0.0;
  QDir(pictures).removeRecursively();  // the session has images of its own

  CameraCalibrationModel again(&head_model, &session, sessions);
  ASSERT_EQ(again.LastSession(), model.Folder());
  again.OpenSession(again.LastSession());
  ASSERT_TRUE(Settled(again));
  ASSERT_EQ(again.Images().size(), 5u);
  EXPECT_EQ(again.Images()[0].state, State::kExcluded);
  EXPECT_EQ(again.Board(), model.Board());
  ASSERT_NE(again.ChosenModel(), nullptr) << again.StateText().toStdString();
  // Ceres orders unknowns by where they lie in memory: the last digits differ.
  EXPECT_NEAR(again.ChosenModel()->camera.fx, focal, 1e-4);
}

TEST_F(CameraCalibrationTest, AnotherBoardIsLookedForInAllImagesAgain) {
  ASSERT_TRUE(Add(4));
  CalibrationBoard wrong = model.Board();
  wrong.columns = 9;
  ASSERT_TRUE(model.SetBoard(wrong));
  ASSERT_TRUE(Settled());
  EXPECT_EQ(model.UsedCount(), 0);
  EXPECT_FALSE(model.Images()[0].reason.isEmpty());
  wrong.columns = 2;
  EXPECT_FALSE(model.SetBoard(wrong));
  EXPECT_EQ(model.Board().columns, 9);
}

TEST_F(CameraCalibrationTest, TheHeadsImageIsTakenOver) {
  EXPECT_FALSE(model.WhyNotTakeFromHead().isEmpty());
  model.takeFromHead();
  EXPECT_EQ(notices.size(), 1u) << "says why not";
  session.SetScan(std::make_shared<const Scan>(
      WallAndValveScan({.from_rad = -0.02, .to_rad = 0.02, .speed_rad_s = 0.1})));
  ASSERT_TRUE(model.WhyNotTakeFromHead().isEmpty());
  model.takeFromHead();
  ASSERT_TRUE(Settled());
  ASSERT_EQ(model.Images().size(), 1u);
  EXPECT_EQ(model.Images()[0].state, State::kRejected) << "there is no board in the scene";
  EXPECT_TRUE(QFile::exists(model.Folder() + "/images/" + model.Images()[0].name));
}

TEST_F(CameraCalibrationTest, WhatIsCancelledSaysSoAndCanBeSolvedAgain) {
  ASSERT_TRUE(Add(4));
  model.solve();
  ASSERT_TRUE(WaitFor([&] { return model.Solving(); }));
  model.cancel();
  ASSERT_TRUE(Settled());
  EXPECT_EQ(model.Calibration(), nullptr);
  EXPECT_THAT(model.StateText().toStdString(), HasSubstr("cancelled"));
  model.solve();
  ASSERT_TRUE(Settled());
  EXPECT_NE(model.Calibration(), nullptr);
}

struct RigVersionTest : CameraCalibrationTest {
  RigVersionModel* rig = model.Rig();
  QString file = folder.filePath("new.yaml");
  const std::string old_id = RigId(head->Rig());

  bool Save() {
    rig->Save(rig->WithCamera(SmallCamera()), file);
    return WaitFor([&] { return !rig->Busy(); });
  }
};

TEST_F(RigVersionTest, ANewVersionNamesItsParentAndReplacesNoFile) {
  ASSERT_TRUE(Save());
  ASSERT_EQ(rig->SavedFile(), file);
  const auto saved = LoadSensorRig(file.toStdString());
  ASSERT_TRUE(saved) << saved.error().message;
  EXPECT_EQ(saved->parent_id, old_id);
  EXPECT_FALSE(saved->date_utc.empty());
  EXPECT_EQ(saved->camera, SmallCamera());
  EXPECT_EQ(saved->camera_from_lidar.Matrix(), head->Rig().camera_from_lidar.Matrix());
  notices.clear();
  ASSERT_TRUE(Save());
  ASSERT_EQ(notices.size(), 1u);
  EXPECT_THAT(notices[0].what.toStdString(), HasSubstr("never replaced"));
}

TEST_F(RigVersionTest, TheHeadTakesTheRigAndGetsTheOldOneBackInOneAction) {
  rig->SetFolder(folder.path());
  rig->putInForce();
  EXPECT_EQ(RigId(head->Rig()), old_id) << "nothing was saved";
  ASSERT_TRUE(Save());
  rig->putInForce();
  ASSERT_TRUE(WaitFor([&] { return !rig->Busy(); }));
  EXPECT_EQ(RigId(head->Rig()), RigId(*LoadSensorRig(file.toStdString())));
  EXPECT_FALSE(rig->WhyNotPutInForce().isEmpty()) << "it is in force";
  // Also by a program that was started again.
  RigVersionModel again(&head_model, &session);
  again.SetFolder(folder.path());
  ASSERT_TRUE(again.WhyNotRollBack().isEmpty()) << again.WhyNotRollBack().toStdString();
  again.rollBack();
  ASSERT_TRUE(WaitFor([&] { return !again.Busy(); }));
  EXPECT_EQ(RigId(head->Rig()), old_id);
}

/// Over a link the head's answer takes seconds.
TEST_F(RigVersionTest, TheWindowDoesNotWaitForTheHeadsAnswer) {
  ASSERT_TRUE(Save());
  std::atomic<bool> in_the_windows_thread{true};
  head->on_rig = [&, window = std::this_thread::get_id()] {
    in_the_windows_thread = std::this_thread::get_id() == window;
  };
  rig->putInForce();
  ASSERT_TRUE(WaitFor([&] { return !rig->Busy(); }));
  EXPECT_FALSE(in_the_windows_thread);
  EXPECT_NE(RigId(head->Rig()), old_id);
}

TEST_F(RigVersionTest, AHeadThatIsBusyKeepsItsRig) {
  ASSERT_TRUE(Save());
  head->SetState(HeadState::kSweeping);
  head_model.Poll();
  EXPECT_THAT(rig->WhyNotPutInForce().toStdString(), HasSubstr("sweeping"));
  rig->putInForce();
  EXPECT_EQ(RigId(head->Rig()), old_id);
}

}  // namespace
}  // namespace foresight
