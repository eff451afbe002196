#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <future>
#include <optional>

#include "hardware/head/scan_assembler.h"
#include "hardware/head/scan_fanout.h"
#include "hardware/head/scan_recorder.h"
#include "tests/core/mission/sample_scan.h"
#include "tests/hardware/tiny_head.h"
#include "tests/support/file_size_limit.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

using testing::HasSubstr;

void SendHeader(ScanSink& sink, const Scan& scan) {
  Scan header = scan;
  header.lines.clear();
  header.frames.clear();
  header.track = {};
  header.state = ScanState::kRunning;
  sink.OnScanStarted(header);
}

void SendRest(ScanSink& sink, const Scan& scan) {
  sink.OnMotorSamples(scan.track.samples());
  for (const LidarLine& line : scan.lines) sink.OnLine(line);
  for (const CameraFrame& frame : scan.frames) sink.OnFrame(frame);
  sink.OnScanEnded(scan.state, scan.reason);
}

void Send(ScanSink& sink, const Scan& scan) {
  SendHeader(sink, scan);
  SendRest(sink, scan);
}

TEST(ScanRecorder, TheMissionFileHoldsWhatTheAssemblerSaw) {
  const TemporaryFolder folder;
  TinyHead tiny;
  ASSERT_TRUE(tiny.Home());
  const std::shared_ptr<MissionFile> mission = MissionFile::Create(folder / "m.mission").value();
  const auto recorder = std::make_shared<ScanRecorder>(mission);
  tiny.sinks = std::make_shared<ScanFanout>(
      std::vector<std::shared_ptr<ScanSink>>{tiny.assembler, recorder, tiny.watch});
  const auto scan = tiny.Run(TinyPlan());
  ASSERT_TRUE(scan);
  const std::int64_t id = recorder->WaitUntilWritten().value();
  EXPECT_TRUE(SameButForTheRig(mission->LoadScan(id).value(), *scan));
}

TEST(ScanRecorder, HandsOnWhatIsOnTheDisk) {
  const TemporaryFolder folder;
  const std::shared_ptr<MissionFile> mission = MissionFile::Create(folder / "m.mission").value();
  const auto then = std::make_shared<ScanAssembler>();
  ScanRecorder recorder(mission, then);
  Send(recorder, SampleScan(1));
  ASSERT_TRUE(recorder.WaitUntilWritten());
  EXPECT_TRUE(SameButForTheRig(*then->Snapshot(), SampleScan(1)));
}

TEST(ScanRecorder, HandsOnNothingThatIsNotInTheFile) {
  const TemporaryFolder folder;
  const std::shared_ptr<MissionFile> mission = MissionFile::Create(folder / "m.mission").value();
  const auto then = std::make_shared<ScanAssembler>();
  ScanRecorder recorder(mission, then);
  Scan scan = SampleScan(1);
  scan.lines.Edit(5).seq = 0;  // backwards
  Send(recorder, scan);
  ASSERT_FALSE(recorder.WaitUntilWritten());
  EXPECT_EQ(then->Snapshot()->lines.size(), 5u);
  EXPECT_EQ(then->Snapshot()->state, ScanState::kInterrupted);
  EXPECT_THAT(then->Snapshot()->reason, HasSubstr("line 0 comes after line 4"));
}

TEST(ScanRecorder, HandsOnNothingThatAFullDiskTookBack) {
  /// Holds the recorder's thread at the header until everything else waits for it.
  class Holding final : public ScanSink {
   public:
    explicit Holding(std::shared_ptr<ScanSink> then) : then_(std::move(then)) {}
    void OnScanStarted(const Scan& header) override {
      then_->OnScanStarted(header);
      held.set_value();
      go.get_future().wait();
    }
    void OnLine(const LidarLine& line) override { then_->OnLine(line); }
    void OnMotorSamples(std::span<const MotorSample> samples) override {
      then_->OnMotorSamples(samples);
    }
    void OnFrame(const CameraFrame& frame) override { then_->OnFrame(frame); }
    void OnScanEnded(ScanState state, const std::string& reason) override {
      then_->OnScanEnded(state, reason);
    }
    std::promise<void> held, go;

   private:
    std::shared_ptr<ScanSink> then_;
  };
  const TemporaryFolder folder;
  const std::shared_ptr<MissionFile> mission = MissionFile::Create(folder / "m.mission").value();
  const auto then = std::make_shared<ScanAssembler>();
  const auto holding = std::make_shared<Holding>(then);
  ScanRecorder recorder(mission, holding);
  Scan scan = SampleScan(1);
  scan.frames.Edit(0) = NoiseFrame(scan.frames[0]);
  SendHeader(recorder, scan);
  holding->held.get_future().wait();
  SendRest(recorder, scan);
  {
    // Room for the lines and not for an image.
    const FileSizeLimit limit(std::filesystem::file_size(folder / "m.mission-wal") + 1'500'000);
    holding->go.set_value();
    ASSERT_FALSE(recorder.WaitUntilWritten());
  }
  const ScanSummary kept = mission->ListScans().value().at(0);
  EXPECT_EQ(kept.lines, static_cast<std::int64_t>(scan.lines.size()));
  EXPECT_EQ(kept.images, 0);
  EXPECT_EQ(kept.state, ScanState::kInterrupted);
  EXPECT_EQ(then->Snapshot()->lines.size(), scan.lines.size());
  EXPECT_EQ(then->Snapshot()->frames.size(), 0u);
  EXPECT_THAT(then->Snapshot()->reason, HasSubstr("20 of"));
}

TEST(ScanRecorder, WritesOnWhenWhoFollowsFails) {
  class Failing final : public ScanSink {
   public:
    void OnScanStarted(const Scan&) override {}
    void OnLine(const LidarLine&) override { throw std::runtime_error("no memory"); }
    void OnMotorSamples(std::span<const MotorSample>) override {}
    void OnFrame(const CameraFrame&) override {}
    void OnScanEnded(ScanState, const std::string&) override { throw std::runtime_error("again"); }
  };
  const TemporaryFolder folder;
  const std::shared_ptr<MissionFile> mission = MissionFile::Create(folder / "m.mission").value();
  ScanRecorder recorder(mission, std::make_shared<Failing>());
  Send(recorder, SampleScan(1));
  const auto id = recorder.WaitUntilWritten();
  ASSERT_TRUE(id);
  EXPECT_TRUE(SameButForTheRig(mission->LoadScan(*id).value(), SampleScan(1)));
  EXPECT_EQ(recorder.Failure(), std::nullopt);
}

TEST(ScanRecorder, WritesOneScanAfterTheOther) {
  const TemporaryFolder folder;
  const std::shared_ptr<MissionFile> mission = MissionFile::Create(folder / "m.mission").value();
  ScanRecorder recorder(mission);
  Send(recorder, SampleScan(1));
  Send(recorder, SampleScan(2));
  const std::int64_t id = recorder.WaitUntilWritten().value();
  ASSERT_EQ(mission->ListScans().value().size(), 2u);
  EXPECT_TRUE(SameButForTheRig(mission->LoadScan(id).value(), SampleScan(2)));
}

/// A link deletes its own copy of a scan after that.
TEST(ScanRecorder, WhatItSaysToBeKeptIsInTheFile) {
  const TemporaryFolder folder;
  const std::shared_ptr<MissionFile> mission = MissionFile::Create(folder / "m.mission").value();
  const auto recorder = std::make_shared<ScanRecorder>(mission);
  ScanFanout all({std::make_shared<ScanAssembler>(), recorder});
  Send(all, SampleScan(1));
  ASSERT_TRUE(all.WaitUntilKept());
  const auto scans = MissionFile::OpenReadOnly(folder / "m.mission").value()->ListScans().value();
  ASSERT_EQ(scans.size(), 1u);
  EXPECT_EQ(scans[0].lines, static_cast<std::int64_t>(SampleScan(1).lines.size()));
  EXPECT_EQ(scans[0].state, SampleScan(1).state);
}

TEST(ScanRecorder, AScanThatCouldNotBeWrittenIsNotKept) {
  const TemporaryFolder folder;
  const std::shared_ptr<MissionFile> mission = MissionFile::Create(folder / "m.mission").value();
  const auto recorder = std::make_shared<ScanRecorder>(mission);
  ScanFanout all({recorder, std::make_shared<ScanAssembler>()});
  ASSERT_TRUE(mission->Close());
  Send(all, SampleScan(1));
  EXPECT_THAT(all.WaitUntilKept().error().message, HasSubstr("is closed"));
}

TEST(ScanRecorder, BeforeTheFirstScanThereIsNothingWritten) {
  const TemporaryFolder folder;
  ScanRecorder recorder(MissionFile::Create(folder / "m.mission").value());
  EXPECT_EQ(recorder.WaitUntilWritten().error().code, ErrorCode::kState);
}

TEST(ScanRecorder, ALineThatCannotBeWrittenEndsTheScanAsInterrupted) {
  const TemporaryFolder folder;
  const std::shared_ptr<MissionFile> mission = MissionFile::Create(folder / "m.mission").value();
  ScanRecorder recorder(mission);
  Scan scan = SampleScan(1);
  scan.lines.Edit(5).seq = 0;  // backwards
  Send(recorder, scan);
  EXPECT_THAT(recorder.WaitUntilWritten().error().message, HasSubstr("line 0 comes after line 4"));
  const ScanSummary summary = mission->ListScans().value().at(0);
  EXPECT_EQ(summary.state, ScanState::kInterrupted);
  EXPECT_EQ(summary.lines, 5);
}

TEST(ScanRecorder, AFullyWrittenScanFollowsAFailedOne) {
  const TemporaryFolder folder;
  const std::shared_ptr<MissionFile> mission = MissionFile::Create(folder / "m.mission").value();
  ScanRecorder recorder(mission);
  Scan bad = SampleScan(1);
  bad.lines.Edit(5).seq = 0;
  Send(recorder, bad);
  Send(recorder, SampleScan(2));
  const std::int64_t id = recorder.WaitUntilWritten().value();
  EXPECT_TRUE(SameButForTheRig(mission->LoadScan(id).value(), SampleScan(2)));
}

TEST(ScanRecorder, ClosedDuringAScanItLeavesAnInterruptedOne) {
  const TemporaryFolder folder;
  const std::shared_ptr<MissionFile> mission = MissionFile::Create(folder / "m.mission").value();
  const Scan scan = SampleScan(1);
  {
    ScanRecorder recorder(mission);
    recorder.OnScanStarted(scan);
    recorder.OnLine(scan.lines[0]);
  }
  const ScanSummary summary = mission->ListScans().value().at(0);
  EXPECT_EQ(summary.state, ScanState::kInterrupted);
  EXPECT_EQ(summary.lines, 1);
}

TEST(ScanRecorder, ADiskThatFillsUpEndsTheSweepAndSaysHowManyLinesWereKept) {
  const TemporaryFolder folder;
  TinyHead tiny;
  ASSERT_TRUE(tiny.Home());
  std::shared_ptr<MissionFile> mission = MissionFile::Create(folder / "m.mission").value();
  auto recorder = std::make_shared<ScanRecorder>(mission);
  tiny.sinks = std::make_shared<ScanFanout>(
      std::vector<std::shared_ptr<ScanSink>>{tiny.assembler, recorder, tiny.watch});
  // The sweep does not run ahead of the disk, as a real one does not.
  std::optional<FileSizeLimit> limit;
  tiny.watch->action_line = 10;
  tiny.watch->action = [&] {
    EXPECT_TRUE(recorder->WaitUntilWritten());
    limit.emplace(std::filesystem::file_size(folder / "m.mission-wal"));
  };
  const auto wait = tiny.lidar;
  wait->tamper = [&](TamperedLidar::Answer answer) {
    static_cast<void>(recorder->WaitUntilWritten());
    return answer;
  };
  const auto scan = tiny.Run(TinyPlan());
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->state, ScanState::kInterrupted);
  EXPECT_THAT(scan->reason, testing::ContainsRegex(": [0-9]+ of 42 lines were kept"));
  EXPECT_LT(scan->lines.size(), 30u) << "nobody recorded the rest of the sweep";
  EXPECT_TRUE(tiny.AtRest());
  EXPECT_EQ(recorder->WaitUntilWritten().error().message, scan->reason);
  limit.reset();
  wait->tamper = nullptr;
  tiny.sinks.reset();
  recorder.reset();
  ASSERT_TRUE(mission->Close());
  const auto kept = MissionFile::Open(folder / "m.mission").value();
  const Scan read = kept->LoadScan(kept->ListScans().value().at(0).id).value();
  EXPECT_EQ(read.state, ScanState::kInterrupted);
  EXPECT_GE(read.lines.size(), 8u);
  EXPECT_THAT(scan->reason, HasSubstr(fmt::format(": {} of 42 lines", read.lines.size())));
}

TEST(ScanRecorder, AClosedMissionIsAnErrorNotACrash) {
  const TemporaryFolder folder;
  const std::shared_ptr<MissionFile> mission = MissionFile::Create(folder / "m.mission").value();
  ScanRecorder recorder(mission);
  ASSERT_TRUE(mission->Close());
  Send(recorder, SampleScan(1));
  EXPECT_THAT(recorder.WaitUntilWritten().error().message, HasSubstr("is closed"));
}

}  // namespace
}  // namespace foresight
