#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"
#include "tests/ui/synthetic_scan.h"
#include "tests/ui/wait_for.h"
#include "ui/viewmodels/depth_view_model.h"
#include "ui/viewmodels/fit_view_model.h"
#include "ui/viewmodels/recording_view_model.h"

namespace foresight {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

/// Dense enough for a fit of the valve; made once.
std::shared_ptr<const Scan> ScanOfValve() {
  static const auto scan = std::make_shared<const Scan>(
      WallAndValveScan({.from_rad = -0.26, .to_rad = 0.26, .speed_rad_s = 0.10}));
  return scan;
}

/// A region has been drawn round the valve, and its fit runs.
struct LateFit : testing::Test {
  void Begin(SessionMode mode) {
    session = std::make_unique<SessionModel>(mode);
    fit = std::make_unique<FitViewModel>(session.get());
    QObject::connect(
        session.get(), &SessionModel::noticed, session.get(),
        [this](const Notice& notice) { notices.push_back(notice.what.toStdString()); });
    DepthViewModel depth(session.get());
    session->SetScan(ScanOfValve());
    ASSERT_TRUE(WaitFor([&] { return !depth.Runner()->Busy() && session->Cloud(); }));
  }
  void DrawValve() {
    const SensorRig& rig = session->ShownScan()->rig;
    const auto center =
        rig.camera.Project(rig.CameraFromBase(session->CurrentImage()->motor_angle_rad) *
                           SyntheticValvePose().translation());
    const Eigen::Vector2d half(50, 50);
    fit->SetTool(ObjectKind::kValve, true);
    fit->DrawRegion({*center - half, *center + half});
    ASSERT_TRUE(fit->Runner()->Busy());
  }
  bool Done() {
    return WaitFor([&] { return !fit->Runner()->Busy(); });
  }

  std::unique_ptr<SessionModel> session;
  std::unique_ptr<FitViewModel> fit;
  std::vector<std::string> notices;
};

TEST_F(LateFit, ASweepThatBeginsDuringAFitTakesNoAnswerAway) {
  Begin(SessionMode::kSimulation);
  TemporaryFolder folder;
  RecordingViewModel recording(session.get());
  recording.Begin(QString::fromStdString((folder / "m.foresight").string()));
  recording.keepScan(ScanOfValve());
  DrawValve();
  session->ExpectScan();
  ASSERT_TRUE(Done());
  ASSERT_EQ(session->Objects().size(), 1u) << testing::PrintToString(notices);
  const FoundObject& object = session->Objects()[0];
  EXPECT_EQ(object.scan_uuid, ScanOfValve()->uuid);
  EXPECT_EQ(object.scan_time, BeginTimeOf(*ScanOfValve()));
  EXPECT_FALSE(session->IsCurrent(object));
  EXPECT_EQ(session->Selected(), &object);
  EXPECT_THAT(notices, Contains(HasSubstr("in the scan before")));
  EXPECT_THAT(notices, Not(Contains(HasSubstr("cancelled"))));
  ASSERT_TRUE(recording.WriteAll());
  const auto file = MissionFile::OpenReadOnly((folder / "m.foresight").string()).value();
  EXPECT_EQ(file->ListDetections().value().size(), 1u);
}

TEST_F(LateFit, ItTakesNoSelectionFromAnObjectOfTheScanOnTheScreen) {
  Begin(SessionMode::kSimulation);
  DrawValve();
  Scan next = *ScanOfValve();
  next.uuid = NewUuid();
  session->SetScan(std::make_shared<const Scan>(next));
  FoundObject seen;
  seen.detection = TerrainDetection();
  seen.scan_uuid = next.uuid;
  session->AddObject(seen);
  ASSERT_TRUE(Done());
  ASSERT_EQ(session->Objects().size(), 2u);
  EXPECT_EQ(session->SelectedObject(), 0);
}

TEST_F(LateFit, AFitOfTheSamePlaceInTheNextScanDoesNotDropIt) {
  Begin(SessionMode::kSimulation);
  DrawValve();
  const auto cloud = session->Cloud();
  Scan next = *ScanOfValve();
  next.uuid = NewUuid();
  session->SetScan(std::make_shared<const Scan>(next));
  session->SetCloud(cloud, next.rig);
  DrawValve();
  ASSERT_TRUE(Done());
  EXPECT_EQ(session->Objects().size(), 2u) << testing::PrintToString(notices);
}

TEST_F(LateFit, InReviewAnotherScanCancelsIt) {
  Begin(SessionMode::kReplay);
  DrawValve();
  Scan next = *ScanOfValve();
  next.uuid = NewUuid();
  session->SetScan(std::make_shared<const Scan>(next));
  ASSERT_TRUE(Done());
  EXPECT_TRUE(session->Objects().empty());
}

}  // namespace
}  // namespace foresight
