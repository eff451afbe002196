#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "core/detection/detection_json.h"
#include "core/mission/mission_file.h"

// Opens what earlier programs wrote: golden/README.md. A value here changes only if the file did,
// and it never does.

namespace foresight {
namespace {

using testing::IsEmpty;
using testing::StartsWith;

std::unique_ptr<MissionFile> Golden(const char* name) {
  return MissionFile::OpenReadOnly(std::filesystem::path(FORESIGHT_SOURCE_DIR) /
                                   "tests/core/mission/golden" / name)
      .value();
}

std::int64_t SumOfRanges(const Scan& scan) {
  std::int64_t sum = 0;
  for (const LidarLine& line : scan.lines)
    sum = std::accumulate(line.range_mm.begin(), line.range_mm.end(), sum);
  return sum;
}

std::int64_t SumOfPixels(const ColorImage& image) {
  std::int64_t sum = 0;
  for (const Rgb8& pixel : image.values()) sum += pixel.r + pixel.g + pixel.b;
  return sum;
}

TEST(GoldenMissionOfFormat1, ItsScansAreListed) {
  const std::vector<ScanSummary> scans = Golden("format1.foresight")->ListScans().value();
  ASSERT_EQ(scans.size(), 2u);
  EXPECT_EQ(scans[0].uuid, "a19bd2a9-56f4-4a3f-a609-65bba937b243");
  EXPECT_EQ(scans[0].start_utc_ns, 1795353234372124006);
  EXPECT_EQ(scans[0].source, "simulated: room, seed 7");
  EXPECT_EQ(scans[0].state, ScanState::kComplete);
  EXPECT_EQ(scans[0].lines, 60);
  EXPECT_EQ(scans[0].images, 2);
  EXPECT_EQ(scans[0].objects, 3);
  EXPECT_EQ(scans[0].thumbnail, "");
  EXPECT_EQ(scans[1].uuid, "c1685b24-cda5-4ec0-bfd8-e6643cdaef53");
  EXPECT_EQ(scans[1].state, ScanState::kInterrupted);
  EXPECT_EQ(scans[1].reason, "the recording program ended before the scan did");
  EXPECT_EQ(scans[1].lines, 8);
  EXPECT_EQ(scans[1].images, 0);
}

TEST(GoldenMissionOfFormat1, ItsScanIsRead) {
  const auto mission = Golden("format1.foresight");
  const Scan scan = mission->LoadScan(1).value();
  EXPECT_EQ(scan.rig.name, "golden");
  EXPECT_EQ(scan.lines.front().seq, 94);
  EXPECT_EQ(scan.lines.front().time_s, 2.35);
  EXPECT_EQ(SumOfRanges(scan), 55160248);
  EXPECT_EQ(scan.track.samples().size(), 418u);
  EXPECT_EQ(scan.frames[1].time_s, 3.630299916666666);
  EXPECT_EQ(scan.frames[1].motor_angle_rad, 4.638412406673349e-05);
  EXPECT_EQ(SumOfPixels(scan.frames[1].image), 4041455);
  EXPECT_EQ(mission->LoadImage(1, 1).value(), scan.frames[1]);
  EXPECT_EQ(mission->ListImages(1)->at(1).width, 112);
  EXPECT_EQ(mission->LoadLines(1, 104, 1)->at(0), scan.lines[10]);
  EXPECT_EQ(mission->LoadTrack(1).value(), scan.track);
}

TEST(GoldenMissionOfFormat1, ItsDetectionsAreOpenAndOfUnknownProvenance) {
  const std::vector<DetectionRecord> detections =
      Golden("format1.foresight")->ListDetections().value();
  ASSERT_EQ(detections.size(), 3u);
  for (const DetectionRecord& detection : detections) {
    EXPECT_EQ(detection.scan_id, 1);
    EXPECT_EQ(detection.scan_uuid, "a19bd2a9-56f4-4a3f-a609-65bba937b243");
    EXPECT_EQ(detection.decision, Decision::kOpen);
    EXPECT_THAT(detection.provenance_json, IsEmpty());
    EXPECT_THAT(detection.author, IsEmpty());
  }
  EXPECT_EQ(detections[0].kind, "valve");
  EXPECT_EQ(detections[0].uuid, "a19bd2a9-56f4-4a3f-a609-65bba937b243#1");
  EXPECT_EQ(detections[0].utc_ns, 1795353237909162335);
  EXPECT_EQ(detections[1].kind, "drill");
  EXPECT_EQ(detections[2].kind, "terrain");
}

TEST(GoldenMissionOfFormat1, ItsDetectionsSpeakOfRivalsAndAreRead) {
  const std::vector<DetectionRecord> detections =
      Golden("format1.foresight")->ListDetections().value();
  const auto valve = std::get<ValveDetection>(DetectionFromJson(detections[0].json).value());
  EXPECT_EQ(valve.best.base_from_object.translation().x(), -0.8892757395593189);
  ASSERT_EQ(valve.alternatives.size(), 3u);
  EXPECT_NEAR(valve.best.log_likelihood - valve.alternatives[0].log_likelihood, 153.59435845757147,
              1e-6);
  const auto drill = std::get<DrillDetection>(DetectionFromJson(detections[1].json).value());
  EXPECT_EQ(drill.verdict.level, VerdictLevel::kConfirmed);
  EXPECT_EQ(drill.alternatives.size(), 3u);
  EXPECT_TRUE(
      std::holds_alternative<TerrainDetection>(DetectionFromJson(detections[2].json).value()));
}

TEST(GoldenMissionOfFormat1, ItsEventsAreRead) {
  const std::vector<EventRecord> events = Golden("format1.foresight")->ListEvents().value();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].utc_ns, 1795353235118899295);
  EXPECT_THAT(events[0].text, StartsWith("scan 1: lidar: 40 lines/s, 0 lost"));
}

TEST(GoldenMissionOfFormat1, EveryByteIsSound) {
  EXPECT_TRUE(Golden("format1.foresight")->Verify({}));
}

TEST(GoldenMissionOfFormat2, IsReadAsItIs) {
  const auto mission = Golden("format2.foresight");
  const std::vector<ScanSummary> scans = mission->ListScans().value();
  ASSERT_EQ(scans.size(), 1u);
  EXPECT_EQ(scans[0].uuid, "790897ad-ec7a-4c52-ac61-039855ce098b");
  EXPECT_EQ(scans[0].begin_utc_ns, 1795559208283236705 + 1'425'000'000);
  EXPECT_EQ(scans[0].lines, 9);
  EXPECT_EQ(scans[0].images, 1);
  EXPECT_FALSE(scans[0].imported);
  EXPECT_FALSE(scans[0].thumbnail.empty());
  const Scan scan = mission->LoadScan(1).value();
  EXPECT_EQ(SumOfRanges(scan), 9932362);
  EXPECT_TRUE(scan.given.empty());
  ASSERT_EQ(mission->ListDepths()->size(), 1u);
  EXPECT_EQ(mission->ListDepths()->at(0).digest,
            "3e92b08a72dbafc1d8ee2d99caf2cc57c169dd8046f94dc90fd8007b81d0a21d");
  EXPECT_EQ(mission->ListEvents()->size(), 1u);
  EXPECT_TRUE(mission->Verify({}));
}

}  // namespace
}  // namespace foresight
