#include <gtest/gtest.h>

#include <QTemporaryDir>

#include "tests/ui/synthetic_scan.h"
#include "tests/ui/wait_for.h"
#include "ui/viewmodels/mission_view_model.h"

namespace foresight {
namespace {

struct MissionTest : testing::Test {
  QTemporaryDir folder;
  QString path = folder.filePath("m.foresight");
  std::shared_ptr<const Scan> scan = std::make_shared<const Scan>(
      WallAndValveScan({.from_rad = -0.02, .to_rad = 0.02, .speed_rad_s = 0.1}));

  FoundObject Valve() const {
    FoundObject valve;
    ValveDetection detection;
    detection.best.model.rim_radius_m = 0.123;
    detection.origin.roi = ImageRoi::Rectangle(0.0, {10, 10}, {50, 50});
    valve.detection = detection;
    valve.rig = scan->rig;
    valve.scan_uuid = scan->uuid;
    return valve;
  }
  void Save() {
    SessionModel session(SessionMode::kSimulation);
    MissionViewModel mission(&session);
    QObject::connect(&session, &SessionModel::noticed,
                     [](const Notice& notice) { ADD_FAILURE() << notice.what.toStdString(); });
    mission.keepScan(scan);
    mission.keepObject(Valve());
    EXPECT_EQ(mission.UnsavedScans(), 1);
    mission.SaveAs(path);
    ASSERT_TRUE(WaitFor([&] { return !mission.Runner()->Busy(); }));
    EXPECT_EQ(mission.UnsavedScans(), 0);
  }
};

TEST_F(MissionTest, WhatWasSavedOpensAgainAsAReplay) {
  Save();
  SessionModel session(SessionMode::kSimulation);
  MissionViewModel mission(&session);
  mission.Open(path);
  ASSERT_TRUE(WaitFor([&] { return !mission.Runner()->Busy(); }));
  EXPECT_EQ(session.Mode(), SessionMode::kReplay);
  ASSERT_NE(session.CurrentScan(), nullptr);
  EXPECT_EQ(session.CurrentScan()->lines, scan->lines);
  ASSERT_EQ(session.Objects().size(), 1u);
  EXPECT_EQ(std::get<ValveDetection>(session.Objects()[0].detection).best.model.rim_radius_m,
            0.123);
  EXPECT_TRUE(session.IsCurrent(session.Objects()[0]));
}

TEST_F(MissionTest, AScanThatWasRecordedWhileItArrivedIsSavedOnce) {
  {
    SessionModel session(SessionMode::kSimulation);
    MissionViewModel mission(&session);
    mission.keepScan(scan);
    mission.SaveAs(path);
    ASSERT_TRUE(WaitFor([&] { return !mission.Runner()->Busy(); }));
    Scan second = *scan;
    second.uuid = NewUuid();
    const auto recorder = mission.Recorder();
    ASSERT_NE(recorder, nullptr);
    Scan header = second;
    header.lines.clear();
    recorder->OnScanStarted(header);
    for (const LidarLine& line : second.lines) recorder->OnLine(line);
    recorder->OnScanEnded(ScanState::kComplete, "");
    mission.keepScan(std::make_shared<const Scan>(second));
    ASSERT_TRUE(WaitFor([&] { return !mission.Runner()->Busy(); }));
  }
  const auto file = MissionFile::OpenReadOnly(path.toStdString());
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ((*file)->ListScans()->size(), 2u);
}

TEST_F(MissionTest, AFileThatIsNoMissionIsReportedAndChangesNothing) {
  SessionModel session(SessionMode::kSimulation);
  MissionViewModel mission(&session);
  int errors = 0;
  QObject::connect(&session, &SessionModel::noticed, [&](const Notice&) { ++errors; });
  mission.Open(folder.filePath("missing.foresight"));
  ASSERT_TRUE(WaitFor([&] { return !mission.Runner()->Busy(); }));
  EXPECT_EQ(errors, 1);
  EXPECT_EQ(session.Mode(), SessionMode::kSimulation);
}

TEST_F(MissionTest, AnExistingFileIsNeverOverwrittenByANewMission) {
  Save();
  SessionModel session(SessionMode::kSimulation);
  MissionViewModel mission(&session);
  int errors = 0;
  QObject::connect(&session, &SessionModel::noticed, [&](const Notice&) { ++errors; });
  mission.keepScan(scan);
  mission.SaveAs(path);
  ASSERT_TRUE(WaitFor([&] { return !mission.Runner()->Busy(); }));
  EXPECT_EQ(errors, 1);
  EXPECT_EQ(mission.UnsavedScans(), 1);
}

}  // namespace
}  // namespace foresight
