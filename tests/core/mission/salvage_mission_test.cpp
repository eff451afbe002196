#include "core/mission/salvage_mission.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <fstream>
#include <set>

#include "core/base/atomic_file.h"
#include "tests/core/mission/sample_scan.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class SalvageMissionTest : public testing::Test {
 protected:
  SalvageMissionTest() {
    const auto mission = MissionFile::Create(good_path_).value();
    for (const std::uint64_t seed : {1, 2}) {
      scans_.push_back(SampleScan(seed));
      const std::int64_t id = Record(*mission, scans_.back());
      DetectionRecord detection;
      detection.scan_id = id;
      detection.kind = "valve";
      detection.json = R"({"score":0.9})";
      detection.provenance_json = R"({"image_position":1,"source":"raw"})";
      const std::int64_t found = mission->AddDetection(detection).value();
      EXPECT_TRUE(mission->AddDetectionEvent(
          found, {44, "operator", DetectionEvent::Action::kAccepted, "looks right"}));
      DepthRecord depth;
      depth.scan_id = id;
      depth.image_position = 1;
      depth.digest = "0123";
      mission->AddDepth(depth).value();
    }
    mission->AddEvent({0, 43, "head", "info", "homed", ""}).value();
    EXPECT_TRUE(mission->Close());
    good_ = ReadFile(good_path_).value();
  }

  Result<SalvageReport> Salvage(const std::string& bytes, const SalvageOptions& options = {}) {
    std::ofstream(bad_path_, std::ios::binary) << bytes;
    return SalvageMission(bad_path_, saved_path_, options, {});
  }

  Result<SalvageReport> SalvageAfter(const std::string& sql, const SalvageOptions& options = {}) {
    std::filesystem::copy_file(good_path_, bad_path_,
                               std::filesystem::copy_options::overwrite_existing);
    sqlite3* connection = nullptr;
    EXPECT_EQ(sqlite3_open(bad_path_.c_str(), &connection), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(connection, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK)
        << sqlite3_errmsg(connection);
    sqlite3_close(connection);
    return SalvageMission(bad_path_, saved_path_, options, {});
  }

  std::unique_ptr<MissionFile> Saved() { return MissionFile::OpenReadOnly(saved_path_).value(); }

  /// Whether everything in the salvaged mission is in the good one, bit for bit.
  void ExpectOnlyTrueContents() {
    const auto saved = Saved();
    ASSERT_TRUE(saved->Verify({}));
    const std::vector<ScanSummary> summaries = saved->ListScans().value();
    for (const ScanSummary& summary : summaries) {
      const Scan scan = saved->LoadScan(summary.id).value();
      const Scan& truth = scans_[static_cast<std::size_t>(summary.id - 1)];
      EXPECT_EQ(scan.uuid, truth.uuid);
      EXPECT_EQ(scan.plan, truth.plan);
      for (const LidarLine& line : scan.lines)
        EXPECT_NE(std::find(truth.lines.begin(), truth.lines.end(), line), truth.lines.end());
      for (const CameraFrame& frame : scan.frames)
        EXPECT_NE(std::find(truth.frames.begin(), truth.frames.end(), frame), truth.frames.end());
      for (const MotorSample& sample : scan.track.samples()) {
        const auto samples = truth.track.samples();
        EXPECT_NE(std::find(samples.begin(), samples.end(), sample), samples.end());
      }
    }
  }

  /// Damages three bytes, or half a page, again and again, and checks what is saved.
  void DamageAndSalvage(std::uint64_t first_seed, int runs) {
    int lines = 0;
    for (int run = 0; run < runs; ++run) {
      const std::uint64_t seed = first_seed + static_cast<std::uint64_t>(run);
      const auto report = Salvage(Damaged(seed));
      ASSERT_TRUE(report) << "seed " << seed << ": " << report.error().message;
      ExpectOnlyTrueContents();
      if (HasFailure()) FAIL() << "seed " << seed;
      for (const SalvagedScan& scan : report->scans)
        if (scan.saved) lines += static_cast<int>(scan.lines);
    }
    // Three bytes reach at most three lines of 40, or the rig or the entry of a scan.
    EXPECT_GT(lines, runs * 40 * 8 / 10);
  }

  std::string Damaged(std::uint64_t seed) const {
    Random random(seed);
    std::string bytes = good_;
    const auto anywhere = [&] {
      return static_cast<std::size_t>(random.Index(static_cast<int>(bytes.size())));
    };
    if (seed % 5 == 0) {  // a torn write: half a page of garbage
      const std::size_t at = anywhere();
      for (std::size_t i = at; i < std::min(bytes.size(), at + 4096); ++i)
        bytes[i] = static_cast<char>(random.Index(256));
      return bytes;
    }
    for (int i = 0; i < 3; ++i) {
      const std::size_t at = anywhere();
      bytes[at] = static_cast<char>(bytes[at] ^ (1 + random.Index(255)));
    }
    return bytes;
  }

  TemporaryFolder folder_;
  const std::filesystem::path good_path_ = folder_ / "good.foresight";
  const std::filesystem::path bad_path_ = folder_ / "bad.foresight";
  const std::filesystem::path saved_path_ = folder_ / "saved.foresight";
  std::vector<Scan> scans_;
  std::string good_;
};

TEST_F(SalvageMissionTest, AWholeMissionComesOutAsItWas) {
  const SalvageReport report = Salvage(good_).value();
  EXPECT_THAT(report.losses, IsEmpty());
  EXPECT_EQ(report.detections, 2);
  EXPECT_EQ(report.depth_maps, 2);
  EXPECT_EQ(report.events, 1);
  const auto good = MissionFile::OpenReadOnly(good_path_).value();
  const auto saved = Saved();
  for (const std::int64_t id : {1, 2})
    EXPECT_TRUE(SameButForTheRig(saved->LoadScan(id).value(), good->LoadScan(id).value()));
  EXPECT_EQ(saved->ListDetections().value(), good->ListDetections().value());
  EXPECT_EQ(saved->ListDepths().value(), good->ListDepths().value());
  EXPECT_EQ(saved->ListEvents().value(), good->ListEvents().value());
}

TEST_F(SalvageMissionTest, OneDamagedLineCostsThatLineOnly) {
  const SalvageReport report =
      SalvageAfter("UPDATE line SET data = zeroblob(100) WHERE scan_id = 1 AND seq = 9").value();
  EXPECT_THAT(report.losses, ElementsAre(HasSubstr("19 of 20 lines")));
  const Scan scan = Saved()->LoadScan(1).value();
  EXPECT_EQ(scan.lines.size(), 19u);
  EXPECT_EQ(scan.state, ScanState::kInterrupted);
  EXPECT_THAT(scan.reason, HasSubstr("19 of 20 lines"));
  EXPECT_TRUE(SameButForTheRig(Saved()->LoadScan(2).value(), scans_[1]));
  ExpectOnlyTrueContents();
}

TEST_F(SalvageMissionTest, AMissionWithoutItsFirstPageIsSaved) {
  // Header and table of contents: SQLite itself reads nothing of such a file.
  std::string bytes = good_;
  std::fill_n(bytes.begin(), 8192, '\xa5');
  const SalvageReport report = Salvage(bytes).value();
  EXPECT_THAT(report.losses, IsEmpty());
  for (const std::int64_t id : {1, 2})
    EXPECT_TRUE(
        SameButForTheRig(Saved()->LoadScan(id).value(), scans_[static_cast<std::size_t>(id - 1)]));
}

TEST_F(SalvageMissionTest, WhereverItIsDamagedWhatIsSavedIsTrueAndHardlyAnythingIsLost) {
  DamageAndSalvage(0, 30);
}

TEST_F(SalvageMissionTest, AtAThousandPlacesToo) {
  DamageAndSalvage(1000, 1000);
}

TEST_F(SalvageMissionTest, ACutFileKeepsWhatIsInFrontOfTheCut) {
  for (const std::size_t tenths : {3, 6, 9}) {
    const auto report = Salvage(good_.substr(0, good_.size() * tenths / 10));
    if (!report) {
      EXPECT_EQ(report.error().code, ErrorCode::kBadData);
      continue;
    }
    ExpectOnlyTrueContents();
    EXPECT_THAT(report->losses, testing::Not(IsEmpty()));
  }
}

TEST_F(SalvageMissionTest, WhatOnlyTheLogHasIsSaved) {
  const auto recording = MissionFile::Create(folder_ / "recording.foresight").value();
  RecordWithoutEnd(*recording, scans_[0]);
  std::filesystem::copy_file(folder_ / "recording.foresight", bad_path_);
  std::filesystem::copy_file(folder_ / "recording.foresight-wal", folder_ / "bad.foresight-wal");
  ASSERT_LT(std::filesystem::file_size(bad_path_), 8192u * 20) << "the log holds the lines";
  const SalvageReport report = SalvageMission(bad_path_, saved_path_, {}, {}).value();
  const Scan scan = Saved()->LoadScan(1).value();
  EXPECT_EQ(scan.lines, scans_[0].lines);
  EXPECT_EQ(scan.frames, scans_[0].frames);
  EXPECT_EQ(scan.state, ScanState::kInterrupted);
  EXPECT_THAT(report.losses, IsEmpty());
}

TEST_F(SalvageMissionTest, RecordsFollowAnImageThatMoved) {
  const SalvageReport report =
      SalvageAfter("UPDATE image_data SET png = x'00' WHERE scan_id = 1 AND position = 0").value();
  EXPECT_THAT(report.losses, ElementsAre(HasSubstr("1 of 2 images")));
  const Scan scan = Saved()->LoadScan(1).value();
  ASSERT_EQ(scan.frames.size(), 1u);
  EXPECT_EQ(scan.frames[0], scans_[0].frames[1]);
  EXPECT_EQ(Saved()->ListDepths(1).value().at(0).image_position, 0);
  EXPECT_THAT(Saved()->ListDetections(1).value().at(0).provenance_json,
              HasSubstr(R"("image_position":0)"));
  EXPECT_EQ(Saved()->ListDepths(2).value().at(0).image_position, 1) << "another scan";
}

TEST_F(SalvageMissionTest, AScanWithoutItsRigIsToldAboutAndSavedWithTheRigThatIsGiven) {
  const std::string no_rig = "UPDATE calibration SET rig_yaml = 'x'";
  const auto without = SalvageAfter(no_rig);
  ASSERT_TRUE(without) << without.error().message;
  EXPECT_THAT(without->losses, testing::Contains(HasSubstr("--rig")));
  EXPECT_THAT(Saved()->ListScans().value(), IsEmpty());
  EXPECT_EQ(Saved()->ListDetections().value().size(), 2u) << "they still name their scans";

  SalvageOptions options;
  options.rig = scans_[0].rig;
  const SalvageReport with = SalvageAfter(no_rig, options).value();
  EXPECT_EQ(Saved()->LoadScan(1).value().lines, scans_[0].lines);
  EXPECT_THAT(with.losses, testing::Contains(HasSubstr("the rig that was given")));
}

TEST_F(SalvageMissionTest, AScanWithoutItsEntryIsSavedWithTheRigThatIsGiven) {
  SalvageOptions options;
  options.rig = scans_[0].rig;
  const auto report = SalvageAfter("UPDATE scan SET source = 'x' WHERE id = 1", options);
  ASSERT_TRUE(report) << report.error().message;
  const Scan scan = Saved()->LoadScan(1).value();
  EXPECT_EQ(scan.lines, scans_[0].lines);
  EXPECT_EQ(scan.state, ScanState::kInterrupted);
  EXPECT_NE(scan.uuid, scans_[0].uuid);
}

TEST_F(SalvageMissionTest, SomethingElseIsAClearErrorAndLeavesNoFile) {
  for (const std::string& bytes : {std::string(), std::string("hello"), std::string(70000, '\0'),
                                   std::string(70000, '\x0d')}) {
    const auto report = Salvage(bytes);
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::kBadData);
    EXPECT_THAT(report.error().message, HasSubstr("bad.foresight"));
    EXPECT_FALSE(std::filesystem::exists(saved_path_));
  }
  EXPECT_EQ(SalvageMission(good_path_, good_path_, {}, {}).error().code, ErrorCode::kInvalidInput);
}

}  // namespace
}  // namespace foresight
