#include "ui/viewmodels/recording_view_model.h"

#include <gtest/gtest.h>

#include <QFileInfo>
#include <QTemporaryDir>
#include <filesystem>

#include "tests/support/file_size_limit.h"
#include "tests/ui/synthetic_scan.h"
#include "tests/ui/wait_for.h"
#include "ui/viewmodels/mission_objects.h"
#include "ui/viewmodels/no_scan_hint.h"

namespace foresight {
namespace {

std::shared_ptr<const Scan> SmallScan() {
  static const auto scan = std::make_shared<const Scan>(
      WallAndValveScan({.from_rad = -0.02, .to_rad = 0.02, .speed_rad_s = 0.1}));
  return scan;
}

FoundObject ValveIn(const Scan& scan) {
  ValveDetection detection;
  detection.best.model.rim_radius_m = 0.123;
  detection.verdict = {VerdictLevel::kLikely, 0.8, "", {}};
  detection.alternatives.resize(1);
  detection.origin.roi = ImageRoi::Rectangle(0.0, {10, 10}, {50, 50});
  FoundObject valve;
  valve.detection = detection;
  valve.rig = scan.rig;
  valve.scan_uuid = scan.uuid;
  return valve;
}

struct RecordingTest : testing::Test {
  QTemporaryDir folder;
  QString path = folder.filePath("m.foresight");
  TaskQueue tasks;
  SessionModel session{SessionMode::kSimulation, &tasks};
  std::unique_ptr<RecordingViewModel> recording = std::make_unique<RecordingViewModel>(&session);
  std::vector<Notice> notices;

  RecordingTest() {
    QObject::connect(&session, &SessionModel::noticed,
                     [this](const Notice& notice) { notices.push_back(notice); });
  }
  void Record(const Scan& scan) {
    const auto sink = recording->Recorder();
    ASSERT_NE(sink, nullptr);
    Scan header = scan;
    header.lines = {};
    header.frames = {};
    header.track = {};
    header.state = ScanState::kRunning;
    sink->OnScanStarted(header);
    sink->OnMotorSamples(scan.track.samples());
    for (const LidarLine& line : scan.lines) sink->OnLine(line);
    for (const CameraFrame& frame : scan.frames) sink->OnFrame(frame);
    sink->OnScanEnded(ScanState::kComplete, "");
    recording->keepScan(std::make_shared<const Scan>(scan));
  }
  bool AllWritten() {
    return WaitFor([&] { return recording->Waiting() == 0 && !recording->Busy(); });
  }
};

TEST_F(RecordingTest, AScanAnObjectAndADecisionAreInTheFileWhileItIsStillRecorded) {
  ASSERT_TRUE(recording->Begin(path));
  Record(*SmallScan());
  session.SetScan(SmallScan());
  session.AddObject(ValveIn(*SmallScan()));
  session.Decide(Decision::kAccepted);
  ASSERT_TRUE(AllWritten());
  EXPECT_TRUE(session.Objects()[0].kept);
  const auto file = MissionFile::OpenReadOnly(path.toStdString());
  ASSERT_TRUE(file) << file.error().message;
  const auto scans = (*file)->ListScans();
  ASSERT_TRUE(scans);
  ASSERT_EQ(scans->size(), 1u);
  EXPECT_EQ((*scans)[0].lines, static_cast<std::int64_t>(SmallScan()->lines.size()));
  const auto objects = (*file)->ListDetections();
  ASSERT_TRUE(objects);
  ASSERT_EQ(objects->size(), 1u);
  EXPECT_EQ((*objects)[0].decision, Decision::kAccepted);
  EXPECT_TRUE(notices.empty());
}

TEST_F(RecordingTest, TheScansOfTheRunningMissionAreListed) {
  ASSERT_TRUE(recording->Begin(path));
  Record(*SmallScan());
  ASSERT_TRUE(AllWritten());
  ASSERT_TRUE(WaitFor([&] { return recording->Scans().size() == 1; }));
  EXPECT_EQ(recording->Scans()[0].uuid, SmallScan()->uuid);
  EXPECT_FALSE(recording->Scans()[0].thumbnail.empty());
}

TEST_F(RecordingTest, WhatCameBeforeThereWasAFileIsWrittenWhenThereIsOne) {
  recording->keepScan(SmallScan());
  session.SetScan(SmallScan());
  session.AddObject(ValveIn(*SmallScan()));
  EXPECT_EQ(recording->Waiting(), 2);
  EXPECT_FALSE(session.Objects()[0].kept);
  recording->SwitchTo(path);
  ASSERT_TRUE(AllWritten());
  EXPECT_TRUE(session.Objects()[0].kept);
  EXPECT_EQ((*MissionFile::OpenReadOnly(path.toStdString()))->ListScans()->size(), 1u);
}

TEST_F(RecordingTest, AScanThatTheDiskDidNotTakeIsWrittenWholeWhenThereIsRoomAgain) {
  ASSERT_TRUE(recording->Begin(path));
  {
    const FileSizeLimit limit(std::filesystem::file_size((path + "-wal").toStdString()) + 20'000);
    recording->keepScan(SmallScan());
    ASSERT_TRUE(WaitFor([&] { return !notices.empty() && !recording->Busy(); }));
  }
  EXPECT_EQ(recording->Waiting(), 1);
  recording->tryAgain();
  ASSERT_TRUE(AllWritten());
  const auto file = MissionFile::OpenReadOnly(path.toStdString()).value();
  const Scan kept = file->LoadScan(file->ListScans()->at(0).id).value();
  EXPECT_EQ(kept.state, SmallScan()->state);
  EXPECT_EQ(kept.lines, SmallScan()->lines);
  EXPECT_EQ(kept.frames, SmallScan()->frames);
  Record(WallAndValveScan({.from_rad = -0.02, .to_rad = 0.02, .speed_rad_s = 0.1}));
  EXPECT_TRUE(AllWritten());
}

TEST_F(RecordingTest, OfAScanWhoseLastSamplesTheDiskDidNotTakeTheRestIsWritten) {
  {
    const auto file = MissionFile::Create(path.toStdString()).value();
    const std::int64_t id = file->BeginScan(*SmallScan()).value();
    const auto samples = SmallScan()->track.samples();
    ASSERT_TRUE(file->AppendMotorSamples(id, samples.first(samples.size() / 2)));
    for (const LidarLine& line : SmallScan()->lines) ASSERT_TRUE(file->AppendLine(id, line));
    for (const CameraFrame& frame : SmallScan()->frames) ASSERT_TRUE(file->AppendFrame(id, frame));
    ASSERT_TRUE(file->EndScan(id, ScanState::kInterrupted, "the disk is full"));
    ASSERT_TRUE(file->Close());
  }
  ASSERT_TRUE(recording->Begin(path));
  recording->keepScan(SmallScan());
  ASSERT_TRUE(AllWritten());
  const auto file = MissionFile::OpenReadOnly(path.toStdString()).value();
  const Scan kept = file->LoadScan(file->ListScans()->at(0).id).value();
  EXPECT_EQ(kept.track, SmallScan()->track);
  EXPECT_EQ(kept.state, SmallScan()->state);
  EXPECT_EQ(kept.reason, SmallScan()->reason);
}

TEST_F(RecordingTest, LinesThatComeAfterTheEndAreKeptToo) {
  ASSERT_TRUE(recording->Begin(path));
  Scan early = *SmallScan();
  early.state = ScanState::kComplete;
  early.lines.Truncate(early.lines.size() - 2);
  Record(early);
  ASSERT_TRUE(AllWritten());
  Scan late = *SmallScan();
  late.state = ScanState::kComplete;
  recording->keepScan(std::make_shared<const Scan>(late));
  ASSERT_TRUE(AllWritten());
  const auto file = MissionFile::OpenReadOnly(path.toStdString()).value();
  EXPECT_EQ(file->LoadScan(file->ListScans()->at(0).id)->lines, late.lines);
}

TEST_F(RecordingTest, ACopyIsCompleteAndRecordingGoesOnInTheFirstFile) {
  ASSERT_TRUE(recording->Begin(path));
  Record(*SmallScan());
  ASSERT_TRUE(AllWritten());
  const QString copy = folder.filePath("copy.foresight");
  recording->CopyTo(copy);
  ASSERT_TRUE(WaitFor([&] { return !recording->Busy() && QFileInfo::exists(copy); }));
  EXPECT_EQ(recording->Path(), path);
  Scan second = *SmallScan();
  second.uuid = NewUuid();
  Record(second);
  ASSERT_TRUE(AllWritten());
  EXPECT_EQ((*MissionFile::OpenReadOnly(copy.toStdString()))->ListScans()->size(), 1u);
  EXPECT_EQ((*MissionFile::OpenReadOnly(path.toStdString()))->ListScans()->size(), 2u);
}

TEST_F(RecordingTest, AFileThatNothingWasRecordedIntoIsNotLeftBehind) {
  ASSERT_TRUE(recording->Begin(path));
  EXPECT_TRUE(QFileInfo::exists(path));
  ASSERT_TRUE(AllWritten());
  recording.reset();
  EXPECT_FALSE(QFileInfo::exists(path));
}

TEST_F(RecordingTest, AFileWithAScanIsClosedAsOneFileAndNotLeftBehind) {
  ASSERT_TRUE(recording->Begin(path));
  Record(*SmallScan());
  ASSERT_TRUE(AllWritten());
  recording.reset();
  EXPECT_TRUE(QFileInfo::exists(path));
  EXPECT_FALSE(QFileInfo::exists(path + "-wal"));
  EXPECT_TRUE(RecordingViewModel::LeftBehind(folder.path()).isEmpty());
}

TEST_F(RecordingTest, TheSessionKnowsHowManyScansTheMissionHeldBefore) {
  ASSERT_TRUE(recording->Begin(path));
  Record(*SmallScan());
  ASSERT_TRUE(AllWritten());
  EXPECT_EQ(session.Earlier().scans, 0) << "a scan of this sitting is none from before";
  EXPECT_EQ(NoScanHint(session), "No scan yet: press Scan (Space)");
  recording.reset();
  SessionModel later(SessionMode::kSimulation, &tasks);
  RecordingViewModel again(&later);
  ASSERT_TRUE(again.Begin(path));
  ASSERT_TRUE(WaitFor([&] { return later.Earlier().scans > 0; }));
  EXPECT_EQ(later.Earlier().scans, 1);
  EXPECT_FALSE(later.CurrentScan()) << "what was seen before is not shown as what is seen now";
  EXPECT_TRUE(NoScanHint(later).contains("in the list of scans"));
}

TEST_F(RecordingTest, AnInterruptedMissionThatIsGoneOnWithSaysWhatItHolds) {
  ASSERT_TRUE(recording->Begin(path));
  Record(*SmallScan());
  session.SetScan(SmallScan());
  session.AddObject(ValveIn(*SmallScan()));
  ASSERT_TRUE(AllWritten());
  recording->Recorder()->OnScanStarted([] {  // and the program is killed in mid sweep
    Scan header = *SmallScan();
    header.uuid = NewUuid();
    header.lines = {};
    header.frames = {};
    header.state = ScanState::kRunning;
    return header;
  }());
  ASSERT_TRUE(recording->Recorder()->WaitUntilKept());
  const QString left = folder.filePath("left.foresight");
  ASSERT_TRUE(QFile::copy(path, left) && QFile::copy(path + "-wal", left + "-wal"));
  SessionModel later(SessionMode::kSimulation, &tasks);
  std::vector<Notice> told;
  QObject::connect(&later, &SessionModel::noticed,
                   [&](const Notice& notice) { told.push_back(notice); });
  RecordingViewModel again(&later);
  ASSERT_TRUE(again.Begin(left));
  EXPECT_EQ(later.Earlier().scans, 2);
  EXPECT_EQ(later.Earlier().objects, 1);
  EXPECT_TRUE(later.Earlier().interrupted.isValid());
  ASSERT_EQ(told.size(), 1u);
  EXPECT_TRUE(told[0].what.startsWith("The program ended unexpectedly the last time."));
  EXPECT_TRUE(told[0].next.startsWith(
      "It holds 2 scans and 1 object from before the restart. The scan of "))
      << told[0].next.toStdString();
  EXPECT_TRUE(NoScanHint(later).endsWith("was interrupted."));
  EXPECT_TRUE(EarlierObjectsHint(later).contains("1 object"));
}

TEST_F(RecordingTest, WhichAnswerWasAcceptedIsReadBackFromTheMission) {
  ASSERT_TRUE(recording->Begin(path));
  Record(*SmallScan());
  session.SetScan(SmallScan());
  session.AddObject(ValveIn(*SmallScan()));
  session.nextCandidate();
  session.Decide(Decision::kAccepted);
  EXPECT_TRUE(recording->WriteAll());
  const auto objects = (*MissionFile::OpenReadOnly(path.toStdString()))->ListDetections();
  ASSERT_TRUE(objects && objects->size() == 1u);
  const auto object = ObjectOf((*objects)[0], SmallScan()->rig, 0);
  ASSERT_TRUE(object);
  EXPECT_EQ(object->decision, Decision::kAccepted);
  EXPECT_EQ(object->decided_candidate, 1);
}

TEST_F(RecordingTest, WhatIsDecidedJustBeforeTheEndIsWrittenToo) {
  ASSERT_TRUE(recording->Begin(path));
  Record(*SmallScan());
  session.SetScan(SmallScan());
  session.AddObject(ValveIn(*SmallScan()));
  session.Decide(Decision::kAccepted);
  EXPECT_TRUE(recording->WriteAll());
  recording.reset();
  const auto objects = (*MissionFile::OpenReadOnly(path.toStdString()))->ListDetections();
  ASSERT_TRUE(objects);
  ASSERT_EQ(objects->size(), 1u);
  EXPECT_EQ((*objects)[0].decision, Decision::kAccepted);
}

/// A mission as a program leaves it that is killed: with its write-ahead log, written by nobody.
void LeaveBehind(const QString& path, const QString& from) {
  QFile::copy(from, path);
  QFile::copy(from + "-wal", path + "-wal");
}

TEST_F(RecordingTest, AnInterruptedMissionIsOfferedAndOneCommandGoesOnInIt) {
  ASSERT_TRUE(recording->Begin(path));
  Record(*SmallScan());
  ASSERT_TRUE(AllWritten());
  const QString left = folder.filePath("left.foresight");
  LeaveBehind(left, path);
  recording = std::make_unique<RecordingViewModel>(&session);
  recording->OfferInterrupted(folder.path());
  EXPECT_EQ(recording->Interrupted(), left);
  ASSERT_FALSE(notices.empty());
  EXPECT_EQ(notices.back().command, "recording.continue");
  const QString fresh = folder.filePath("fresh.foresight");
  ASSERT_TRUE(recording->Begin(fresh));
  recording->continueInterrupted();
  ASSERT_TRUE(WaitFor([&] { return recording->Path() == left && recording->Scans().size() == 1; }));
  EXPECT_TRUE(recording->Interrupted().isEmpty());
  EXPECT_FALSE(QFileInfo::exists(fresh)) << "nothing was recorded into it";
}

TEST_F(RecordingTest, GoesBackToAFileOfTheSameSitting) {
  const QString second = folder.filePath("second.foresight");
  ASSERT_TRUE(recording->Begin(path));
  Record(*SmallScan());
  ASSERT_TRUE(AllWritten());
  recording->SwitchTo(second);
  ASSERT_TRUE(WaitFor([&] { return recording->Path() == second && !recording->Busy(); }));
  notices.clear();
  recording->SwitchTo(path);
  EXPECT_TRUE(WaitFor([&] { return recording->Path() == path && !recording->Busy(); }, 2000));
  recording->SwitchTo(path);
  ASSERT_TRUE(AllWritten());
  for (const Notice& notice : notices)
    EXPECT_EQ(notice.level, Notice::Level::kInfo) << notice.what.toStdString();
  Scan more = *SmallScan();
  more.uuid = NewUuid();
  Record(more);
  ASSERT_TRUE(AllWritten());
  EXPECT_EQ((*MissionFile::OpenReadOnly(path.toStdString()))->ListScans()->size(), 2u);
}

TEST_F(RecordingTest, AnInterruptedMissionInAnotherFolderIsOfferedToo) {
  ASSERT_TRUE(recording->Begin(path));
  Record(*SmallScan());
  ASSERT_TRUE(AllWritten());
  QTemporaryDir elsewhere;
  const QString left = elsewhere.filePath("left.foresight");
  LeaveBehind(left, path);
  recording->OfferInterrupted(QTemporaryDir().path(), left);
  EXPECT_EQ(recording->Interrupted(), left);
}

TEST_F(RecordingTest, AnOfferStandsAtTheNextStartAgainAndAfterLooking) {
  ASSERT_TRUE(recording->Begin(path));
  Record(*SmallScan());
  ASSERT_TRUE(AllWritten());
  const QString left = folder.filePath("left.foresight");
  LeaveBehind(left, path);
  recording->OfferInterrupted(folder.path());
  { const auto looked_at = MissionFile::OpenReadOnly(left.toStdString()); }
  EXPECT_EQ(RecordingViewModel::LeftBehind(folder.path()), QStringList{left});
}

TEST_F(RecordingTest, AMissionThatIsRecordedIntoIsNotOffered) {
  ASSERT_TRUE(recording->Begin(path));
  Record(*SmallScan());
  ASSERT_TRUE(AllWritten());
  const QString left = folder.filePath("left.foresight");
  LeaveBehind(left, path);
  recording = std::make_unique<RecordingViewModel>(&session);
  recording->OfferInterrupted(folder.path());
  ASSERT_TRUE(recording->Begin(left));
  EXPECT_TRUE(recording->Interrupted().isEmpty());
}

TEST_F(RecordingTest, AFileThatIsDeletedUnderTheRecordingIsSaidAndTheNextOneHoldsAllOfIt) {
  ASSERT_TRUE(recording->Begin(path));
  Record(*SmallScan());
  recording->keepObject(ValveIn(*SmallScan()));
  ASSERT_TRUE(AllWritten());
  for (const char* suffix : {"", "-wal", "-shm"}) QFile::remove(path + suffix);
  notices.clear();
  ASSERT_TRUE(WaitFor([&] { return !notices.empty(); }, 10'000)) << "nobody has to write for it";
  EXPECT_EQ(notices.back().level, Notice::Level::kError);
  EXPECT_TRUE(notices.back().what.contains(path));
  Scan second = *SmallScan();
  second.uuid = NewUuid();
  recording->keepScan(std::make_shared<const Scan>(second));
  ASSERT_TRUE(WaitFor([&] { return !recording->Busy() && recording->Stuck(); }));
  const QString copy = folder.filePath("copy.foresight"), next = folder.filePath("next.foresight");
  recording->CopyTo(copy);
  ASSERT_TRUE(WaitFor([&] { return !recording->Busy() && QFileInfo::exists(copy); }));
  EXPECT_EQ((*MissionFile::OpenReadOnly(copy.toStdString()))->ListScans()->size(), 1u);
  for (const QString& taken : {path, copy}) {
    notices.clear();
    recording->SwitchTo(taken);
    ASSERT_TRUE(WaitFor([&] { return !notices.empty() && !recording->Busy(); }));
    EXPECT_TRUE(notices.front().what.contains("choose a new name"));
    EXPECT_EQ(recording->Path(), path);
  }
  recording->SwitchTo(next);
  ASSERT_TRUE(WaitFor([&] { return recording->Path() == next; }));
  ASSERT_TRUE(AllWritten());
  const auto file = MissionFile::OpenReadOnly(next.toStdString()).value();
  EXPECT_EQ(file->ListScans()->size(), 2u);
  EXPECT_EQ(file->ListDetections()->size(), 1u);
}

TEST_F(RecordingTest, AFileThatIsBroughtBackIsWrittenAgain) {
  ASSERT_TRUE(recording->Begin(path));
  const QString away = folder.filePath("away.foresight");
  ASSERT_TRUE(QFile::rename(path, away));
  recording->keepScan(SmallScan());
  ASSERT_TRUE(WaitFor([&] { return !recording->Busy() && recording->Stuck(); }));
  ASSERT_TRUE(WaitFor(
      [&] {
        for (const Notice& notice : notices)
          if (notice.what.contains("moved or deleted while")) return true;
        return false;
      },
      10'000));
  ASSERT_TRUE(QFile::rename(away, path));
  EXPECT_TRUE(WaitFor([&] { return recording->Waiting() == 0; }, 10'000));
}

// As the file of a program that was killed, which takes some seconds to go.
TEST_F(RecordingTest, AFileThatAnotherProgramWritesIsTakenWhenThatEnds) {
  auto other = MissionFile::Create(path.toStdString()).value();
  EXPECT_FALSE(recording->Begin(path));
  ASSERT_FALSE(notices.empty());
  EXPECT_TRUE(notices.back().next.contains("until that program ends"));
  recording->keepScan(SmallScan());
  EXPECT_TRUE(recording->Stuck());
  ASSERT_TRUE(other->Close());
  other.reset();
  ASSERT_TRUE(WaitFor([&] { return recording->Recording(); }, 10'000));
  ASSERT_TRUE(AllWritten());
  EXPECT_EQ((*MissionFile::OpenReadOnly(path.toStdString()))->ListScans()->size(), 1u);
}

TEST_F(RecordingTest, AFileThatCannotBeWrittenIsSaidAndNothingIsLost) {
  EXPECT_FALSE(recording->Begin(folder.filePath("no/such/folder/m.foresight")));
  ASSERT_FALSE(notices.empty());
  EXPECT_EQ(notices.back().level, Notice::Level::kError);
  EXPECT_EQ(recording->Recorder(), nullptr);
  recording->keepScan(SmallScan());
  EXPECT_EQ(recording->Waiting(), 1);
}

}  // namespace
}  // namespace foresight
