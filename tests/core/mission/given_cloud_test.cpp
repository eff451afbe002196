// Clouds of imported scans in the mission file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "core/mission/complete_scan.h"
#include "core/mission/diff_missions.h"
#include "core/mission/given_codec.h"
#include "core/mission/merge_missions.h"
#include "core/mission/pose_message.h"
#include "core/mission/salvage_mission.h"
#include "core/registration/export_cloud.h"
#include "tests/core/mission/sample_scan.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

using testing::HasSubstr;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// 5 lines of 7 beams with holes, intensities and times.
GivenCloud SampleCloud() {
  GivenCloud cloud;
  cloud.lines = 5;
  cloud.beams = 7;
  for (int line = 0; line < cloud.lines; ++line) {
    const float y = static_cast<float>(line);
    cloud.origins.push_back({0.1f * y, 0.0f, 0.01f});
    for (int beam = 0; beam < cloud.beams; ++beam) {
      const bool hole = (line + beam) % 4 == 0;
      cloud.points.push_back(hole ? Eigen::Vector3f::Constant(kNaN)
                                  : Eigen::Vector3f(0.3f * static_cast<float>(beam), y, 4.0f));
      cloud.intensity.push_back(hole ? 0.0f : 10.0f * y);
      cloud.time_s.push_back(hole ? std::numeric_limits<double>::quiet_NaN()
                                  : 1.5 + 0.025 * line + 1e-5 * beam);
    }
  }
  return cloud;
}

Scan ImportedSample() {
  Scan scan = SampleScan(3);
  scan.lines.clear();
  scan.track = MotorTrack();
  scan.given = SampleCloud();
  scan.source = "imported: sample.ply";
  scan.simulated = false;
  return scan;
}

std::int64_t Keep(MissionFile& mission, const Scan& scan) {
  return CompleteScan(mission, scan).value();
}

class GivenClouds : public testing::Test {
 protected:
  TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "m.foresight";
  const Scan scan_ = ImportedSample();
};

TEST_F(GivenClouds, AreReadAsTheyWereWritten) {
  const auto mission = MissionFile::Create(path_).value();
  const std::int64_t id = Keep(*mission, scan_);
  const Scan read = mission->LoadScan(id).value();
  EXPECT_TRUE(read.given == scan_.given);
  EXPECT_TRUE(SameButForTheRig(read, scan_));
  const ScanSummary summary = mission->Summary(id).value();
  EXPECT_TRUE(summary.imported);
  EXPECT_EQ(summary.lines, 5);
  EXPECT_EQ(summary.begin_utc_ns, BeginUtc_ns(scan_)) << "that of the first point with a time";
  EXPECT_TRUE(mission->Verify({}));
}

TEST_F(GivenClouds, AreRegisteredAsTheyStand) {
  const RegisteredScan cloud = RegisterScan(scan_, {}).value();
  ASSERT_EQ(cloud.lines, 5);
  ASSERT_EQ(cloud.beams, 7);
  EXPECT_FALSE(cloud.Valid(0, 0));
  ASSERT_TRUE(cloud.Valid(2, 1));
  EXPECT_EQ(cloud.points[cloud.Index(2, 1)], scan_.given.points[cloud.Index(2, 1)]);
  EXPECT_FLOAT_EQ(cloud.range_m[cloud.Index(2, 1)],
                  (Eigen::Vector3f(0.3f, 2.0f, 4.0f) - Eigen::Vector3f(0.2f, 0.0f, 0.01f)).norm());
  const std::vector<CloudPoint> points = PointsInRobot(cloud, scan_);
  EXPECT_EQ(points.size(), 26u);
  EXPECT_EQ(points.front().time_s, scan_.given.time_s[1]);
}

TEST_F(GivenClouds, ACloudThatIsNoneIsRefusedByName) {
  GivenCloud cloud = SampleCloud();
  cloud.beams = 8;
  EXPECT_THAT(cloud.Check().error().message, HasSubstr("35 points"));
  cloud = SampleCloud();
  cloud.origins.Truncate(4);
  cloud.origins.push_back(Eigen::Vector3f::Constant(kNaN));
  EXPECT_THAT(cloud.Check().error().message, HasSubstr("line 4"));
  const auto mission = MissionFile::Create(path_).value();
  const std::int64_t id = mission->BeginScan(scan_).value();
  EXPECT_EQ(mission->SetGivenCloud(id, cloud).error().code, ErrorCode::kInvalidInput);
  ASSERT_TRUE(mission->SetGivenCloud(id, SampleCloud()));
  EXPECT_EQ(mission->SetGivenCloud(id, SampleCloud()).error().code, ErrorCode::kState)
      << "a scan has one cloud";
}

TEST_F(GivenClouds, AFlippedBitIsFoundAndNamesTheLine) {
  const auto mission = MissionFile::Create(path_).value();
  Keep(*mission, scan_);
  ASSERT_TRUE(mission->Close());
  {
    auto database = SqliteDatabase::Open(path_, SqliteDatabase::Mode::kReadWrite).value();
    ASSERT_TRUE(database.Run("UPDATE given_line SET time_s = time_s + 1 WHERE line = 3"));
  }
  const auto damaged = MissionFile::OpenReadOnly(path_).value();
  const Status verified = damaged->Verify({});
  ASSERT_FALSE(verified);
  EXPECT_THAT(verified.error().message, HasSubstr("line 3 of its cloud is damaged"));
}

TEST_F(GivenClouds, ALineThatIsLostIsSavedAsAHole) {
  const auto mission = MissionFile::Create(path_).value();
  Keep(*mission, scan_);
  ASSERT_TRUE(mission->Close());
  {
    auto database = SqliteDatabase::Open(path_, SqliteDatabase::Mode::kReadWrite).value();
    ASSERT_TRUE(database.Run("UPDATE given_line SET time_s = time_s + 1 WHERE line = 3"));
  }
  const SalvageReport report = SalvageMission(path_, folder_ / "saved.foresight", {}, {}).value();
  ASSERT_EQ(report.scans.size(), 1u);
  EXPECT_EQ(report.scans[0].lines, 4);
  EXPECT_EQ(report.scans[0].lines_before, 5);
  const auto saved = MissionFile::OpenReadOnly(folder_ / "saved.foresight").value();
  const Scan scan = saved->LoadScan(1).value();
  EXPECT_EQ(scan.state, ScanState::kInterrupted);
  ASSERT_EQ(scan.given.lines, 5);
  for (int beam = 0; beam < 7; ++beam) {
    EXPECT_TRUE(scan.given.points[scan.given.Index(3, beam)].hasNaN());
    const std::size_t at = scan.given.Index(4, beam);
    EXPECT_EQ(scan.given.intensity[at], scan_.given.intensity[at]);
  }
  EXPECT_TRUE(RegisterScan(scan, {}));
}

TEST_F(GivenClouds, AreMergedAndCompared) {
  const auto mission = MissionFile::Create(path_).value();
  Keep(*mission, scan_);
  ASSERT_TRUE(mission->Close());
  const auto other = MissionFile::Create(folder_ / "other.foresight").value();
  Scan changed = scan_;
  GivenCloud& given = changed.given;
  given.intensity.Truncate(34);
  given.intensity.push_back(99.0f);
  Keep(*other, changed);
  Record(*other, SampleScan(8));
  const std::vector<std::filesystem::path> sources = {path_};
  ASSERT_TRUE(MergeMissions(sources, folder_ / "merged.foresight", {}, {}));
  const auto merged = MissionFile::OpenReadOnly(folder_ / "merged.foresight").value();
  EXPECT_TRUE(merged->LoadScan(1)->given == scan_.given);
  EXPECT_TRUE(merged->Verify({}));
  const auto same = MissionFile::OpenReadOnly(path_).value();
  EXPECT_TRUE(DiffMissions(*same, *merged, {})->empty());
  const auto differences = DiffMissions(*same, *other, {}).value();
  ASSERT_EQ(differences.size(), 2u);
  EXPECT_THAT(differences[0].text + differences[1].text,
              HasSubstr("given cloud: was 5 lines of 7 beams, is 5 of 7, with other values"));
}

TEST_F(GivenClouds, NoRobotGetsAPoseOfOne) {
  const auto mission = MissionFile::Create(path_).value();
  const std::int64_t id = Keep(*mission, scan_);
  DetectionRecord record;
  record.id = 4;
  const auto message =
      PoseMessageOf(record, 0, scan_.rig, mission->Summary(id).value(), scan_.start_utc_ns);
  ASSERT_FALSE(message);
  EXPECT_THAT(message.error().message, HasSubstr("its scan was imported"));
}

TEST(GivenCodec, DamagedBytesAreNeverALine) {
  const GivenCloud cloud = SampleCloud();
  const PackedGivenLine good = PackGivenLine(cloud, 2).value();
  const auto add = [](const PackedGivenLine& packed, std::int64_t line = 0) {
    GivenCloudBuilder builder;
    return builder.Add(line, packed);
  };
  EXPECT_TRUE(add(good));
  PackedGivenLine bad = good;
  bad.beams = 8;
  EXPECT_FALSE(add(bad)) << "another number of beams";
  bad = good;
  bad.parts = 4;
  EXPECT_FALSE(add(bad)) << "parts that are not known";
  bad = good;
  bad.bytes.resize(bad.bytes.size() / 2);
  EXPECT_FALSE(add(bad)) << "half of the bytes";
  bad = good;
  bad.beams = std::int64_t{1} << 40;
  EXPECT_FALSE(add(bad)) << "beams without end";
  EXPECT_FALSE(add(good, std::int64_t{1} << 40)) << "lines without end";
  EXPECT_FALSE(add(good, -1));
}

}  // namespace
}  // namespace foresight
