#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <functional>
#include <thread>

#include "core/base/atomic_file.h"
#include "core/mission/mission_file.h"
#include "tests/core/mission/other_process.h"
#include "tests/core/mission/sample_scan.h"
#include "tests/support/file_size_limit.h"
#include "tests/support/temporary_folder.h"

// One writer records, others read: in the same process and in another one.

namespace foresight {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class MissionReaders : public testing::Test {
 protected:
  std::vector<std::string> Names() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
      names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }

  /// Opens the mission for writing: 0 = it could, 1 = it is in use, 2 = another error.
  std::function<int()> OpenForWriting() const {
    return [this] {
      const auto mission = MissionFile::Open(path_);
      if (mission) return 0;
      return mission.error().message.find("is in use by another program") != std::string::npos ? 1
                                                                                               : 2;
    };
  }

  TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "m.foresight";
};

TEST_F(MissionReaders, ASecondConnectionSeesARunningScanGrow) {
  const Scan scan = SampleScan(1);
  const auto recorder = MissionFile::Create(path_).value();
  const std::int64_t id = recorder->BeginScan(scan).value();
  ASSERT_TRUE(recorder->AppendLine(id, scan.lines[0]));

  const auto reader = MissionFile::OpenReadOnly(path_).value();
  EXPECT_EQ(reader->Summary(id)->state, ScanState::kRunning);
  EXPECT_EQ(reader->Summary(id)->lines, 1);
  ASSERT_TRUE(recorder->AppendLine(id, scan.lines[1]));
  EXPECT_THAT(reader->LoadScan(id)->lines, ElementsAre(scan.lines[0], scan.lines[1]));
  EXPECT_EQ(reader->LoadScan(id)->state, ScanState::kRunning);
  EXPECT_EQ(reader->LoadHeader(id)->state, ScanState::kRunning);
  ASSERT_TRUE(recorder->EndScan(id, ScanState::kComplete, ""));
  EXPECT_EQ(reader->Summary(id)->state, ScanState::kComplete);
}

TEST_F(MissionReaders, AnotherProcessReadsWhileThisOneRecords) {
  const Scan scan = SampleScan(1);
  OtherProcess other([&] {
    const auto reader = MissionFile::OpenReadOnly(path_);
    if (!reader) return 1;
    const auto read = (*reader)->LoadScan(1);
    if (!read || read->lines != scan.lines) return 2;
    return read->state == ScanState::kRunning ? 0 : 3;
  });
  const auto recorder = MissionFile::Create(path_).value();
  const std::int64_t id = RecordWithoutEnd(*recorder, scan);
  EXPECT_EQ(other.Run(), 0);
  ASSERT_TRUE(recorder->EndScan(id, ScanState::kComplete, ""));
}

TEST_F(MissionReaders, ASecondWriterIsToldThatTheFileIsInUse) {
  OtherProcess meanwhile(OpenForWriting());
  OtherProcess afterwards(OpenForWriting());
  const auto recorder = MissionFile::Create(path_).value();
  const auto second = MissionFile::Open(path_);
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, ErrorCode::kIo);
  EXPECT_THAT(second.error().message, HasSubstr("m.foresight: is in use: this program"));
  EXPECT_EQ(meanwhile.Run(), 1);
  ASSERT_TRUE(recorder->Close());
  EXPECT_EQ(afterwards.Run(), 0);
}

TEST_F(MissionReaders, ReadersThatComeAndGoDoNotUnlockTheWriter) {
  OtherProcess other(OpenForWriting());
  const auto recorder = MissionFile::Create(path_).value();
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(MissionFile::OpenReadOnly(path_).value()->ListScans());
  EXPECT_FALSE(MissionFile::Open(path_));
  EXPECT_EQ(other.Run(), 1);
  EXPECT_TRUE(recorder->AddEvent({}));
}

TEST_F(MissionReaders, AWriterThatLeavesDoesNotUnlockTheReaders) {
  // Closing a descriptor drops SQLite's locks in this process. Without them a writer elsewhere
  // would take its log away from under the reader here, and read and write on with another one.
  OtherProcess other(OpenForWriting());
  auto recorder = MissionFile::Create(path_).value();
  const std::int64_t id = RecordWithoutEnd(*recorder, SampleScan(1));
  const auto reader = MissionFile::OpenReadOnly(path_).value();
  ASSERT_TRUE(reader->ListScans());
  ASSERT_TRUE(recorder->Close());
  ASSERT_EQ(other.Run(), 0);
  EXPECT_TRUE(std::filesystem::exists(path_.string() + "-wal"));  // SQLite knew of the reader
  EXPECT_EQ(reader->LoadScan(id)->lines.size(), 20u);
}

TEST_F(MissionReaders, TheLastOneToCloseLeavesOneFile) {
  auto recorder = MissionFile::Create(path_).value();
  Record(*recorder, SampleScan(1));
  auto reader = MissionFile::OpenReadOnly(path_).value();
  ASSERT_TRUE(reader->ListScans());
  ASSERT_TRUE(recorder->Close());
  EXPECT_EQ(reader->ListScans()->size(), 1u);
  ASSERT_TRUE(reader->Close());
  EXPECT_THAT(Names(), ElementsAre("m.foresight"));
  EXPECT_TRUE(MissionFile::OpenReadOnly(path_).value()->WasClosedProperly());
}

TEST_F(MissionReaders, AReaderOfAClosedFileFollowsARecordingThatBeginsLater) {
  MissionFile::Create(path_).value().reset();
  const auto reader = MissionFile::OpenReadOnly(path_).value();
  EXPECT_TRUE(reader->ListScans()->empty());
  auto recorder = MissionFile::Open(path_).value();
  const std::int64_t id = RecordWithoutEnd(*recorder, SampleScan(1));
  EXPECT_EQ(reader->Summary(id)->state, ScanState::kRunning);
  EXPECT_EQ(reader->Summary(id)->lines, 20);
  recorder.reset();
  EXPECT_EQ(reader->Summary(id)->state, ScanState::kInterrupted);
}

TEST_F(MissionReaders, WhenTheRecordingProcessIsKilledItsScanReadsAsInterrupted) {
  const Scan scan = SampleScan(1);
  MissionFile::Create(path_).value().reset();
  OtherProcess other([&] {
    const auto recorder = MissionFile::Open(path_).value();
    RecordWithoutEnd(*recorder, scan);
    raise(SIGKILL);
    return 0;
  });
  ASSERT_EQ(other.Run(), -1);
  const auto reader = MissionFile::OpenReadOnly(path_).value();
  EXPECT_FALSE(reader->IsBeingRecorded());
  EXPECT_FALSE(reader->WasClosedProperly());
  EXPECT_EQ(reader->LoadScan(1)->lines, scan.lines);
  EXPECT_EQ(reader->Summary(1)->state, ScanState::kInterrupted);
  EXPECT_EQ(reader->Summary(1)->reason, "the recording program ended before the scan did");
}

TEST_F(MissionReaders, OneScanIsOneMomentWhileItGrows) {
  Scan scan = SampleScan(1);
  const auto recorder = MissionFile::Create(path_).value();
  const std::int64_t id = recorder->BeginScan(scan).value();
  std::jthread writer([&] {
    for (const LidarLine& line : scan.lines) EXPECT_TRUE(recorder->AppendLine(id, line));
    for (const CameraFrame& frame : scan.frames) EXPECT_TRUE(recorder->AppendFrame(id, frame));
    EXPECT_TRUE(recorder->EndScan(id, ScanState::kComplete, ""));
  });
  const auto reader = MissionFile::OpenReadOnly(path_).value();
  ScanState state = ScanState::kRunning;
  while (state == ScanState::kRunning) {
    const auto read = reader->LoadScan(id);
    ASSERT_TRUE(read) << read.error().message;
    state = read->state;
  }
  EXPECT_EQ(reader->LoadScan(id)->lines.size(), scan.lines.size());
}

TEST_F(MissionReaders, ABatchInProgressKeepsNoReaderWaiting) {
  const Scan scan = SampleScan(1);
  const auto recorder = MissionFile::Create(path_).value();
  const std::int64_t id = recorder->BeginScan(scan).value();
  const auto reader = MissionFile::OpenReadOnly(path_).value();
  const Status batch = recorder->Batch([&]() -> Status {
    FORESIGHT_CHECK(recorder->AppendLine(id, scan.lines[0]));
    // In this very thread: the writer's transaction is open and its lock is held.
    EXPECT_EQ(reader->Summary(id)->lines, 0);
    return {};
  });
  ASSERT_TRUE(batch);
  EXPECT_EQ(reader->Summary(id)->lines, 1);
}

TEST_F(MissionReaders, TheMainFileAloneDoesNotPassForAClosedOne) {
  OtherProcess copier([this] {
    std::error_code error;
    std::filesystem::copy_file(path_, folder_ / "alone.foresight", error);
    return error ? 1 : 0;
  });
  const auto recorder = MissionFile::Create(path_).value();
  RecordWithoutEnd(*recorder, SampleScan(1));
  ASSERT_TRUE(recorder->ExportTo(folder_ / "export.foresight"));
  ASSERT_EQ(copier.Run(), 0);
  const auto alone = MissionFile::OpenReadOnly(folder_ / "alone.foresight");
  ASSERT_FALSE(alone) << "all is in the log that was not copied";
  EXPECT_THAT(alone.error().message, HasSubstr("is not a mission file"));
  EXPECT_TRUE(MissionFile::OpenReadOnly(folder_ / "export.foresight").value()->WasClosedProperly());
  EXPECT_FALSE(MissionFile::OpenReadOnly(path_).value()->WasClosedProperly());
}

TEST_F(MissionReaders, AScanThatRunsEndsInACopyAndGoesOnInTheFile) {
  const auto recorder = MissionFile::Create(path_).value();
  RecordWithoutEnd(*recorder, SampleScan(1));
  const auto reader = MissionFile::OpenReadOnly(path_).value();
  ASSERT_TRUE(reader->ExportTo(folder_ / "read.foresight"));
  ASSERT_TRUE(recorder->ExportTo(folder_ / "written.foresight"));
  for (const char* name : {"read.foresight", "written.foresight"}) {
    const auto copy = MissionFile::OpenReadOnly(folder_ / name).value();
    const ScanSummary scan = copy->ListScans()->at(0);
    EXPECT_EQ(scan.state, ScanState::kInterrupted) << name;
    EXPECT_THAT(scan.reason, HasSubstr("copied while the scan was running")) << name;
    EXPECT_EQ(copy->LoadScan(scan.id)->lines.size(), SampleScan(1).lines.size());
    EXPECT_TRUE(copy->WasClosedProperly());
  }
  EXPECT_EQ(reader->ListScans()->at(0).state, ScanState::kRunning);
}

TEST_F(MissionReaders, AFileThatWasDeletedIsCopiedFromWhatIsOpen) {
  const auto recorder = MissionFile::Create(path_).value();
  RecordWithoutEnd(*recorder, SampleScan(1));
  EXPECT_FALSE(recorder->HasMoved());
  for (const char* suffix : {"", "-wal", "-shm"}) std::filesystem::remove(path_.string() + suffix);
  EXPECT_TRUE(recorder->HasMoved());
  ASSERT_TRUE(recorder->ExportTo(folder_ / "rescued.foresight"));
  const auto copy = MissionFile::OpenReadOnly(folder_ / "rescued.foresight").value();
  EXPECT_EQ(copy->LoadScan(1)->lines.size(), SampleScan(1).lines.size());
}

// "copy.foresight: cannot export: mission.foresight: the disk is full (make room there)"
TEST_F(MissionReaders, ACopyThatFindsNoRoomNamesItsOwnFile) {
  const auto recorder = MissionFile::Create(path_).value();
  RecordWithoutEnd(*recorder, SampleScan(1));
  const FileSizeLimit limit(4096);
  const Status copied = recorder->ExportTo(folder_ / "copy.foresight");
  ASSERT_FALSE(copied);
  EXPECT_THAT(copied.error().message, HasSubstr("copy.foresight"));
  EXPECT_THAT(copied.error().message, Not(HasSubstr(path_.string())));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "copy.foresight"));
}

TEST_F(MissionReaders, ADirectoryAndAPipeAreNoMissions) {
  EXPECT_THAT(MissionFile::OpenReadOnly(folder_.path()).error().message,
              HasSubstr("is not a file"));
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_THAT(MissionFile::OpenReadOnly(folder_ / "pipe").error().message,
              HasSubstr("is not a file"));
  EXPECT_THAT(MissionFile::Open(folder_ / "none").error().message, HasSubstr("does not exist"));
}

TEST_F(MissionReaders, AFailedCreateLeavesNothingBehind) {
  std::filesystem::create_directories(path_.string() + "-wal");  // SQLite cannot make its log
  std::ofstream(path_.string() + "-wal/x") << "x";
  ASSERT_FALSE(MissionFile::Create(path_));
  EXPECT_THAT(Names(), ElementsAre("m.foresight-wal"));
}

}  // namespace
}  // namespace foresight
