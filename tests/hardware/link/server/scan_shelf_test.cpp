#include "hardware/link/server/scan_shelf.h"

#include <gmock/gmock.h>

#include <fstream>

#include "core/mission/mission_file.h"
#include "tests/core/mission/sample_scan.h"
#include "tests/hardware/tiny_head.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;

Scan HeaderOf(Scan scan) {
  scan.lines.clear();
  scan.frames.clear();
  scan.track = {};
  scan.state = ScanState::kRunning;
  return scan;
}

ScanPrediction Expected() {
  ScanPrediction expected;
  expected.lines = 10;
  expected.bytes = 1 << 20;
  return expected;
}

/// Waits until the shelf has seen to the end of the scan.
ShelvedScan Ended(const ScanShelf& shelf, const std::string& uuid) {
  std::int64_t seen = 0;
  for (int news = 0; news < 1000; ++news) {
    const ShelvedScan scan = shelf.Find(uuid).value();
    if (scan.state != ScanState::kRunning) return scan;
    seen = shelf.WaitForNews(seen, milliseconds(2000));
  }
  ADD_FAILURE() << "the scan does not end";
  return {};
}

void Send(ScanSink& sink, const Scan& scan) {
  sink.OnScanStarted(HeaderOf(scan));
  sink.OnMotorSamples(scan.track.samples());
  for (const LidarLine& line : scan.lines) sink.OnLine(line);
  for (const CameraFrame& frame : scan.frames) sink.OnFrame(frame);
  sink.OnScanEnded(scan.state, scan.reason);
}

class ScanShelfTest : public testing::Test {
 protected:
  std::unique_ptr<ScanShelf> Open(double disk_ratio = 0.9) {
    return ScanShelf::Open({folder / "scans", disk_ratio}).value();
  }

  const TemporaryFolder folder;
};

TEST_F(ScanShelfTest, KeepsAScanUnderTheNameThatTheStationGaveIt) {
  const auto shelf = Open();
  Send(*shelf->Begin("11111111-aaaa", Expected()).value(), SampleScan(3));
  const ShelvedScan scan = Ended(*shelf, "11111111-aaaa");
  EXPECT_EQ(scan.state, SampleScan(3).state);
  EXPECT_EQ(scan.lines, static_cast<int>(SampleScan(3).lines.size()));
  Scan expected = SampleScan(3);
  expected.uuid = "11111111-aaaa";
  EXPECT_TRUE(SameButForTheRig(*shelf->Snapshot("11111111-aaaa").value(), expected));
}

TEST_F(ScanShelfTest, ASnapshotGrowsWhileTheScanRuns) {
  const auto shelf = Open();
  const Scan scan = SampleScan(3);
  const auto sink = shelf->Begin("a", Expected()).value();
  EXPECT_EQ(shelf->Snapshot("a").error().code, ErrorCode::kState);
  sink->OnScanStarted(HeaderOf(scan));
  sink->OnLine(scan.lines[0]);
  sink->OnLine(scan.lines[1]);
  std::int64_t seen = 0;
  for (int news = 0; news < 100 && shelf->Find("a")->lines < 2; ++news)
    seen = shelf->WaitForNews(seen, milliseconds(2000));
  const auto snapshot = shelf->Snapshot("a").value();
  EXPECT_EQ(snapshot->lines.size(), 2u);
  EXPECT_EQ(snapshot->state, ScanState::kRunning);
  sink->OnScanEnded(ScanState::kAborted, "enough");
  EXPECT_EQ(Ended(*shelf, "a").reason, "enough");
  EXPECT_EQ(snapshot->lines.size(), 2u);
}

TEST_F(ScanShelfTest, AScanThatRanWhenTheHeadDiedIsThereAfterwardsAsInterrupted) {
  const Scan scan = SampleScan(3);
  {
    const auto shelf = Open();
    const auto sink = shelf->Begin("a", Expected()).value();
    sink->OnScanStarted(HeaderOf(scan));
    sink->OnLine(scan.lines[0]);
  }
  const auto shelf = Open();
  const ShelvedScan found = shelf->Find("a").value();
  EXPECT_EQ(found.state, ScanState::kInterrupted);
  EXPECT_EQ(shelf->Snapshot("a").value()->lines.size(), 1u);
}

TEST_F(ScanShelfTest, ConfirmationIsKept) {
  {
    const auto shelf = Open();
    const auto sink = shelf->Begin("a", Expected()).value();
    sink->OnScanStarted(HeaderOf(SampleScan(3)));
    EXPECT_THAT(shelf->Confirm("a", "anna").error().message, HasSubstr("has not ended"));
    sink->OnScanEnded(ScanState::kComplete, "");
    Ended(*shelf, "a");
    EXPECT_TRUE(shelf->Confirm("a", "anna"));
    EXPECT_TRUE(shelf->Confirm("a", "anna")) << "twice is harmless";
  }
  EXPECT_TRUE(Open()->Find("a")->confirmed);
}

TEST_F(ScanShelfTest, ConfirmedScansMakeRoomAndOthersStay) {
  ScanPrediction expected = Expected();
  const auto shelf = Open();
  for (const char* uuid : {"a", "b"}) {
    Send(*shelf->Begin(uuid, expected).value(), SampleScan(3));
    Ended(*shelf, uuid);
  }
  ASSERT_TRUE(shelf->Confirm("b", "anna"));
  expected.bytes = shelf->FreeBytes();  // fits only when something goes
  const auto refused = shelf->Begin("c", expected);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("1 scans that no station has yet"));
  EXPECT_TRUE(shelf->Find("a")) << "nobody has it";
  EXPECT_FALSE(shelf->Find("b")) << "a station has it";
}

TEST_F(ScanShelfTest, AScanThatDidNotStartLeavesNothing) {
  const auto shelf = Open();
  const auto sink = shelf->Begin("a", Expected()).value();
  shelf->Withdraw("a");
  EXPECT_FALSE(shelf->Find("a"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / "scans"),
                          std::filesystem::directory_iterator()),
            0);
}

TEST_F(ScanShelfTest, TwoScansOfOneNameAreRefused) {
  const auto shelf = Open();
  const auto sink = shelf->Begin("a", Expected()).value();
  EXPECT_THAT(shelf->Begin("a", Expected()).error().message, HasSubstr("has a scan a already"));
  sink->OnScanStarted(HeaderOf(SampleScan(3)));
  sink->OnScanEnded(ScanState::kComplete, "");
  Ended(*shelf, "a");
}

TEST_F(ScanShelfTest, ADamagedFileIsLeftAloneAndTheOthersAreOffered) {
  {
    const auto shelf = Open();
    Send(*shelf->Begin("a", Expected()).value(), SampleScan(3));
    Ended(*shelf, "a");
  }
  std::ofstream(folder / "scans" / "broken.foresight") << "no mission file at all, but some text";
  const auto shelf = Open();
  EXPECT_EQ(shelf->List().size(), 1u);
  EXPECT_TRUE(std::filesystem::exists(folder / "scans" / "broken.foresight"));
}

TEST_F(ScanShelfTest, ARealSweepIsOnTheShelfAsTheHeadSawIt) {
  const auto shelf = Open();
  TinyHead tiny;
  ASSERT_TRUE(tiny.Home());
  tiny.sinks = std::make_shared<ScanFanout>(std::vector<std::shared_ptr<ScanSink>>{
      tiny.assembler, shelf->Begin("sweep", Expected()).value(), tiny.watch});
  const auto scan = tiny.Run(TinyPlan());
  ASSERT_TRUE(scan);
  Ended(*shelf, "sweep");
  Scan expected = *scan;
  expected.uuid = "sweep";
  EXPECT_TRUE(SameButForTheRig(*shelf->Snapshot("sweep").value(), expected));
  EXPECT_THAT(shelf->DeviceHealthJson("sweep"), HasSubstr("at_end"));
}

}  // namespace
}  // namespace foresight
