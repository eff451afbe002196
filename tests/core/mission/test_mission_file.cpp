#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <new>
#include <thread>

#include "core/mission/mission_file.h"
#include "core/mission/row_checksum.h"
#include "core/mission/sqlite.h"
#include "tests/core/mission/sample_scan.h"
#include "tests/support/file_size_limit.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(MissionFile, AScanComesBackBitForBit) {
  const TemporaryFolder folder;
  const Scan scan = SampleScan(1);
  std::int64_t id = 0;
  {
    const auto mission = MissionFile::Create(folder / "m.mission").value();
    id = Record(*mission, scan);
  }
  const auto mission = MissionFile::OpenReadOnly(folder / "m.mission").value();
  EXPECT_TRUE(SameButForTheRig(mission->LoadScan(id).value(), scan));
}

TEST(MissionFile, AScanWithoutALineBeganWithItsMotorAndNotWithTheHeadsClock) {
  const TemporaryFolder folder;
  const Scan scan = SampleScan(1);
  const auto mission = MissionFile::Create(folder / "m.mission").value();
  const std::int64_t id = mission->BeginScan(scan).value();
  const MotorSample late{.time_s = 120.5, .angle_rad = 0.1};
  ASSERT_TRUE(mission->AppendMotorSamples(id, std::span(&late, 1)));
  ASSERT_TRUE(mission->EndScan(id, ScanState::kInterrupted, "the lidar was lost"));
  EXPECT_EQ(mission->ListScans().value()[0].begin_utc_ns, scan.start_utc_ns + 120'500'000'000);
  EXPECT_EQ(mission->ListScans().value()[0].begin_utc_ns,
            BeginUtc_ns(mission->LoadScan(id).value()));
}

TEST(MissionFile, AScanThatEndedTooEarlyIsContinuedToTheWhole) {
  const TemporaryFolder folder;
  const Scan scan = SampleScan(1);
  const auto mission = MissionFile::Create(folder / "m.mission").value();
  const std::int64_t id = mission->BeginScan(scan).value();
  const auto samples = scan.track.samples();
  ASSERT_TRUE(mission->AppendMotorSamples(id, samples.first(40)));
  for (std::size_t i = 0; i < 9; ++i) ASSERT_TRUE(mission->AppendLine(id, scan.lines[i]));
  ASSERT_TRUE(mission->AppendFrame(id, scan.frames[0]));
  ASSERT_TRUE(mission->EndScan(id, ScanState::kInterrupted, "the disk is full"));

  ASSERT_TRUE(mission->ContinueScan(id));
  EXPECT_EQ(mission->BeginScan(SampleScan(2)).error().code, ErrorCode::kState);
  EXPECT_FALSE(mission->AppendLine(id, scan.lines[8])) << "it is there";
  for (std::size_t i = 9; i < scan.lines.size(); ++i)
    ASSERT_TRUE(mission->AppendLine(id, scan.lines[i]));
  ASSERT_TRUE(mission->AppendMotorSamples(id, samples));
  ASSERT_TRUE(mission->AppendFrame(id, scan.frames[1]));
  ASSERT_TRUE(mission->EndScan(id, scan.state, scan.reason));
  EXPECT_TRUE(SameButForTheRig(mission->LoadScan(id).value(), scan));
  EXPECT_TRUE(mission->Verify({}));
  EXPECT_FALSE(mission->ContinueScan(id + 1));
}

TEST(MissionFile, AScanOfWhichTheEndCannotBeWrittenBlocksNoOtherAndIsContinued) {
  const TemporaryFolder folder;
  const Scan scan = SampleScan(1);
  const auto mission = MissionFile::Create(folder / "m.mission").value();
  const std::int64_t id = mission->BeginScan(scan).value();
  ASSERT_TRUE(mission->AppendLine(id, scan.lines[0]));
  {
    const FileSizeLimit disk_full(1);
    EXPECT_EQ(mission->EndScan(id, ScanState::kComplete, "").error().code, ErrorCode::kIo);
  }
  EXPECT_EQ(mission->Summary(id).value().state, ScanState::kInterrupted);
  const std::int64_t next = mission->BeginScan(SampleScan(2)).value();
  ASSERT_TRUE(mission->EndScan(next, ScanState::kComplete, ""));

  ASSERT_TRUE(mission->ContinueScan(id));
  ASSERT_TRUE(mission->EndScan(id, ScanState::kComplete, ""));
  EXPECT_EQ(mission->Summary(id).value().state, ScanState::kComplete);
  EXPECT_TRUE(mission->Verify({}));
}

TEST(MissionFile, AScanIsFoundByItsUuid) {
  const TemporaryFolder folder;
  const auto mission = MissionFile::Create(folder / "m.mission").value();
  Record(*mission, SampleScan(1));
  const std::int64_t id = Record(*mission, SampleScan(2));
  EXPECT_EQ(mission->FindScan(SampleScan(2).uuid).value(), id);
  EXPECT_EQ(mission->FindScan("another").value(), std::nullopt);
}

/// Rewrites the plan of the only scan, with the checksum that goes with it.
void RewritePlan(const std::filesystem::path& path, const std::string& plan_json) {
  SqliteDatabase database = SqliteDatabase::Open(path, SqliteDatabase::Mode::kReadWrite).value();
  SqliteStatement row = database
                            .Prepare(
                                "SELECT id, uuid, calibration_id, start_utc_ns, source, "
                                "simulated, state, reason, lines, motor_batches, frames "
                                "FROM scan")
                            .value();
  ASSERT_TRUE(row.Step().value());
  RowChecksum checksum;
  checksum.Add(row.Integer(0)).Add(row.Text(1)).Add(row.Integer(2)).Add(row.Integer(3));
  checksum.Add(row.Text(4)).Add(row.Integer(5)).Add(plan_json).Add(row.Text(6)).Add(row.Text(7));
  checksum.Add(row.Integer(8)).Add(row.Integer(9)).Add(row.Integer(10));
  ASSERT_FALSE(row.Step().value());
  SqliteStatement update = database.Prepare("UPDATE scan SET plan_json = ?, crc32 = ?").value();
  ASSERT_TRUE(update.BindText(plan_json).Bind(checksum.value()).Run());
}

TEST(MissionFile, AMissionOfAProgramThatKnewLessOfThePlanStillOpens) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "m.mission";
  {
    const auto mission = MissionFile::Create(path).value();
    Record(*mission, SampleScan(1));
    ASSERT_TRUE(mission->Close());
  }
  RewritePlan(path,
              R"({"exposure_s":0.004,"from_rad":-0.5,"gain_db":3.0,"image_angles_rad":[0.25],)"
              R"("speed_rad_s":0.2,"to_rad":0.5})");

  const auto mission = MissionFile::OpenReadOnly(path).value();
  const auto scan = mission->LoadScan(mission->ListScans().value().front().id);

  ASSERT_TRUE(scan) << scan.error().message;
  EXPECT_THAT(scan->plan.image_angles_rad, ElementsAre(0.25));
  EXPECT_EQ(scan->plan.passes, ScanPlan().passes);
  EXPECT_EQ(scan->plan.image_mode, ScanPlan().image_mode);
}

TEST(MissionFile, TheRigComesBack) {
  const TemporaryFolder folder;
  const Scan scan = SampleScan(1);
  const auto mission = MissionFile::Create(folder / "m.mission").value();
  const SensorRig rig = mission->LoadScan(Record(*mission, scan)).value().rig;
  EXPECT_EQ(rig.camera, scan.rig.camera);
  EXPECT_EQ(rig.lidar, scan.rig.lidar);
  EXPECT_EQ(rig.angle_correction, scan.rig.angle_correction);
  // Rigid normalises its quaternion again, which may move the last digit.
  EXPECT_TRUE(rig.camera_from_lidar.Matrix().isApprox(scan.rig.camera_from_lidar.Matrix(), 1e-14));
}

TEST(MissionFile, AClosedMissionIsOneFile) {
  const TemporaryFolder folder;
  const auto mission = MissionFile::Create(folder / "m.mission").value();
  Record(*mission, SampleScan(1));
  ASSERT_TRUE(mission->Close());
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    names.push_back(entry.path().filename().string());
  EXPECT_THAT(names, ElementsAre("m.mission"));
}

TEST(MissionFile, AnExportIsCompleteWhileTheRecordingGoesOn) {
  const TemporaryFolder folder;
  const Scan scan = SampleScan(1);
  const auto mission = MissionFile::Create(folder / "m.mission").value();
  const std::int64_t first = Record(*mission, scan);
  mission->BeginScan(SampleScan(2)).value();
  ASSERT_TRUE(mission->ExportTo(folder / "out.mission"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out.mission-wal"));
  const auto exported = MissionFile::OpenReadOnly(folder / "out.mission").value();
  EXPECT_TRUE(SameButForTheRig(exported->LoadScan(first).value(), scan));
}

TEST(MissionFile, ListsScansWithoutLoadingThem) {
  const TemporaryFolder folder;
  const auto mission = MissionFile::Create(folder / "m.mission").value();
  Scan aborted = SampleScan(2);
  aborted.state = ScanState::kAborted;
  aborted.reason = "the operator stopped it";
  Record(*mission, SampleScan(1));
  Record(*mission, aborted);
  const std::vector<ScanSummary> scans = mission->ListScans().value();
  ASSERT_EQ(scans.size(), 2u);
  EXPECT_EQ(scans[0].state, ScanState::kComplete);
  EXPECT_EQ(scans[0].lines, 20);
  EXPECT_EQ(scans[0].images, 2);
  EXPECT_EQ(scans[1].reason, "the operator stopped it");
  EXPECT_EQ(scans[1].plan, aborted.plan);
}

TEST(MissionFile, ARunningScanShowsWhatItHasSoFar) {
  const TemporaryFolder folder;
  const auto mission = MissionFile::Create(folder / "m.mission").value();
  const std::int64_t id = RecordWithoutEnd(*mission, SampleScan(1));
  EXPECT_EQ(mission->ListScans().value()[0].state, ScanState::kRunning);
  EXPECT_EQ(mission->ListScans().value()[0].lines, 20);
  EXPECT_EQ(mission->LoadScan(id).value().lines.size(), 20u);
}

/// The files of a mission whose program was killed: a copy taken while it was open.
void CopyAsIfKilled(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::filesystem::copy_file(from, to);
  std::filesystem::copy_file(from.string() + "-wal", to.string() + "-wal");
}

TEST(MissionFile, AKilledRecordingLosesNothingAndIsInterrupted) {
  const TemporaryFolder folder;
  const Scan scan = SampleScan(1);
  const auto mission = MissionFile::Create(folder / "m.mission").value();
  const std::int64_t id = RecordWithoutEnd(*mission, scan);
  CopyAsIfKilled(folder / "m.mission", folder / "killed.mission");

  const auto reopened = MissionFile::Open(folder / "killed.mission").value();
  const Scan loaded = reopened->LoadScan(id).value();
  EXPECT_EQ(loaded.lines, scan.lines);
  EXPECT_EQ(loaded.state, ScanState::kInterrupted);
  EXPECT_EQ(loaded.reason, "the recording program ended before the scan did");
  EXPECT_EQ(reopened->ListScans().value()[0].state, ScanState::kInterrupted);
}

TEST(MissionFile, AKilledRecordingReadOnlyReadsAsInterrupted) {
  const TemporaryFolder folder;
  const auto mission = MissionFile::Create(folder / "m.mission").value();
  const std::int64_t id = RecordWithoutEnd(*mission, SampleScan(1));
  CopyAsIfKilled(folder / "m.mission", folder / "killed.mission");
  const auto reopened = MissionFile::OpenReadOnly(folder / "killed.mission").value();
  EXPECT_EQ(reopened->LoadScan(id).value().state, ScanState::kInterrupted);
  EXPECT_EQ(reopened->ListScans().value()[0].state, ScanState::kInterrupted);
}

TEST(MissionFile, ATornLogKeepsACleanBeginning) {
  const TemporaryFolder folder;
  const Scan scan = SampleScan(1);
  const auto mission = MissionFile::Create(folder / "m.mission").value();
  const std::int64_t id = RecordWithoutEnd(*mission, scan);
  CopyAsIfKilled(folder / "m.mission", folder / "torn.mission");
  const std::filesystem::path wal = folder / "torn.mission-wal";
  std::filesystem::resize_file(wal, std::filesystem::file_size(wal) * 2 / 3);
  const Scan loaded = MissionFile::Open(folder / "torn.mission").value()->LoadScan(id).value();
  ASSERT_GT(loaded.lines.size(), 5u);
  ASSERT_LE(loaded.lines.size(), scan.lines.size());
  EXPECT_TRUE(std::equal(loaded.lines.begin(), loaded.lines.end(), scan.lines.begin()));
}

TEST(MissionFile, ReadOnlyLeavesNoTraceAndRefusesToWrite) {
  const TemporaryFolder folder;
  MissionFile::Create(folder / "m.mission").value().reset();
  const auto written = std::filesystem::last_write_time(folder / "m.mission");
  const auto mission = MissionFile::OpenReadOnly(folder / "m.mission").value();
  EXPECT_EQ(mission->BeginScan(SampleScan(1)).error().code, ErrorCode::kState);
  EXPECT_EQ(mission->AddEvent({}).error().code, ErrorCode::kState);
  EXPECT_EQ(std::filesystem::last_write_time(folder / "m.mission"), written);
  EXPECT_FALSE(std::filesystem::exists(folder / "m.mission-shm"));
}

TEST(MissionFile, APathWithSpecialCharactersIsFound) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "50% of #3? \xc3\xa9.mission";
  MissionFile::Create(path).value().reset();
  EXPECT_TRUE(std::filesystem::exists(path));
  EXPECT_TRUE(MissionFile::OpenReadOnly(path));
}

TEST(MissionFile, CreateNeverReplacesAFile) {
  const TemporaryFolder folder;
  std::ofstream(folder / "m.mission") << "precious";
  EXPECT_EQ(MissionFile::Create(folder / "m.mission").error().code, ErrorCode::kIo);
  EXPECT_EQ(std::filesystem::file_size(folder / "m.mission"), 8u);
}

TEST(MissionFile, KeepsEvents) {
  const TemporaryFolder folder;
  EventRecord event{0, 43, "head", "warning", "the lidar lost 3 lines", "{}"};
  {
    const auto mission = MissionFile::Create(folder / "m.mission").value();
    event.id = mission->AddEvent(event).value();
  }
  const auto mission = MissionFile::OpenReadOnly(folder / "m.mission").value();
  EXPECT_THAT(mission->ListEvents().value(), ElementsAre(event));
}

TEST(MissionFile, OneScanRunsAtATime) {
  const TemporaryFolder folder;
  const auto mission = MissionFile::Create(folder / "m.mission").value();
  mission->BeginScan(SampleScan(1)).value();
  EXPECT_EQ(mission->BeginScan(SampleScan(2)).error().code, ErrorCode::kState);
}

TEST(MissionFile, AnEndedScanTakesNoMoreLines) {
  const TemporaryFolder folder;
  const Scan scan = SampleScan(1);
  const auto mission = MissionFile::Create(folder / "m.mission").value();
  const std::int64_t id = Record(*mission, scan);
  EXPECT_EQ(mission->AppendLine(id, scan.lines[0]).error().code, ErrorCode::kState);
}

TEST(MissionFile, ImpossibleLinesAreRefusedByName) {
  const TemporaryFolder folder;
  const Scan scan = SampleScan(1);
  const auto mission = MissionFile::Create(folder / "m.mission").value();
  const std::int64_t id = mission->BeginScan(scan).value();
  ASSERT_TRUE(mission->AppendLine(id, scan.lines[5]));
  EXPECT_THAT(mission->AppendLine(id, scan.lines[4]).error().message,
              HasSubstr("line 4 comes after line 5"));
  LidarLine timeless = scan.lines[6];
  timeless.time_s = std::nan("");
  EXPECT_THAT(mission->AppendLine(id, timeless).error().message, HasSubstr("line 6: time nan"));
}

TEST(MissionFile, ABatchIsWrittenWholeOrNotAtAll) {
  const TemporaryFolder folder;
  const Scan scan = SampleScan(1);
  const auto mission = MissionFile::Create(folder / "m.mission").value();
  const std::int64_t id = mission->BeginScan(scan).value();
  const auto append = [&](std::initializer_list<std::size_t> lines) {
    return mission->Batch([&]() -> Status {
      for (const std::size_t line : lines)
        FORESIGHT_CHECK(mission->AppendLine(id, scan.lines[line]));
      return {};
    });
  };
  EXPECT_EQ(append({0, 1, 0}).error().code, ErrorCode::kInvalidInput);
  EXPECT_TRUE(mission->LoadScan(id).value().lines.empty());
  ASSERT_TRUE(append({0, 1, 2})) << "it begins where the file is";
  EXPECT_EQ(mission->LoadScan(id).value().lines.size(), 3u);
  EXPECT_THROW((void)mission->Batch([&]() -> Status {
    EXPECT_TRUE(mission->AppendLine(id, scan.lines[3]));
    throw std::bad_alloc();
  }),
               std::bad_alloc);
  EXPECT_EQ(mission->LoadScan(id).value().lines.size(), 3u);
  ASSERT_TRUE(append({3}));
}

TEST(MissionFile, ABatchThatADiskDoesNotTakeIsAnErrorWhateverItsBodySays) {
  const TemporaryFolder folder;
  const Scan scan = SampleScan(1);
  const auto mission = MissionFile::Create(folder / "m.mission").value();
  const std::int64_t id = mission->BeginScan(scan).value();
  {
    // More than SQLite keeps in memory: it writes, fails and takes everything back before the end.
    const FileSizeLimit disk_full(std::filesystem::file_size(folder / "m.mission-wal"));
    const Status batch = mission->Batch([&]() -> Status {
      EXPECT_TRUE(mission->AppendLine(id, scan.lines[0]));
      EXPECT_FALSE(mission->AppendFrame(id, NoiseFrame(scan.frames[0])));
      EXPECT_FALSE(mission->AppendLine(id, scan.lines[1])) << "what follows is of the batch";
      return {};
    });
    ASSERT_FALSE(batch);
    EXPECT_THAT(batch.error().message, HasSubstr("m.mission"));
  }
  EXPECT_EQ(mission->Summary(id).value().lines, 0);
  ASSERT_TRUE(mission->AppendLine(id, scan.lines[0]));
  EXPECT_EQ(mission->Summary(id).value().lines, 1);
}

TEST(MissionFile, ANegativeZeroIsNoDamage) {
  const TemporaryFolder folder;
  Scan scan = SampleScan(1);
  scan.frames.Edit(0).target_angle_rad = -0.0;
  scan.frames.Edit(0).gain_db = -0.0;
  const auto mission = MissionFile::Create(folder / "m.mission").value();
  EXPECT_EQ(mission->LoadScan(Record(*mission, scan)).value().frames, scan.frames);
}

TEST(MissionFile, ThreadsMayWriteAndListAtTheSameTime) {
  const TemporaryFolder folder;
  const Scan scan = SampleScan(1);
  const auto mission = MissionFile::Create(folder / "m.mission").value();
  std::jthread writer([&] { Record(*mission, scan); });
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(mission->ListScans());
  writer.join();
  EXPECT_EQ(mission->ListScans().value()[0].lines, 20);
}

TEST(MissionFile, AfterCloseEveryCallSaysSo) {
  const TemporaryFolder folder;
  const auto mission = MissionFile::Create(folder / "m.mission").value();
  ASSERT_TRUE(mission->Close());
  EXPECT_EQ(mission->ListScans().error().code, ErrorCode::kState);
  EXPECT_EQ(mission->AddEvent({}).error().code, ErrorCode::kState);
  EXPECT_EQ(mission->Verify({}).error().code, ErrorCode::kState);
}

}  // namespace
}  // namespace foresight
