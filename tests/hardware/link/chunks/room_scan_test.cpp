// What the link was designed with, on a scan of the room: hardware budgets that must hold.
#include <gtest/gtest.h>

#include "core/base/gray_image.h"
#include "core/geometry/angles.h"
#include "core/io/png.h"
#include "core/registration/register_scan.h"
#include "core/simulation/scene.h"
#include "core/simulation/simulate_scan.h"
#include "hardware/link/chunks/scan_builder.h"
#include "tests/hardware/link/chunks/random_scans.h"

namespace foresight {
namespace {

const Scan& RoomScan() {
  static const Scan kScan = [] {
    auto scene = LoadScene(FORESIGHT_SOURCE_DIR "/resources/scenes/room.yaml").value();
    const World world(std::make_shared<const Scene>(std::move(scene)), DefaultSensorRig(), {});
    ScanPlan plan;
    plan.from_rad = RadiansFromDegrees(-30.0);
    plan.to_rad = RadiansFromDegrees(80.0);
    plan.speed_rad_s = RadiansFromDegrees(10.0);
    plan.image_angles_rad = {0.0};
    return SimulateScan(world, plan, {}).value();
  }();
  return kScan;
}

std::size_t BytesOf(ChunkKind kind) {
  const ScanToSend source{RoomScan(), ""};
  std::size_t bytes = 0;
  for (std::int64_t item = 0; item < ItemsOf(source)[kind]; ++item)
    bytes += EncodeItem(source, {kind, item})->size();
  return bytes;
}

double RawBytes() {
  return 2.0 * 1081.0 * static_cast<double>(RoomScan().lines.size());
}

TEST(RoomScan, RangesTakeAtMost40PercentOfTheirRawBytes) {
  const double ratio = static_cast<double>(BytesOf(ChunkKind::kRanges)) / RawBytes();
  RecordProperty("ratio", std::to_string(ratio));
  EXPECT_LT(ratio, 0.40);
}

TEST(RoomScan, IntensitiesTakeAtMost70PercentOfTheirRawBytes) {
  const double ratio = static_cast<double>(BytesOf(ChunkKind::kIntensities)) / RawBytes();
  RecordProperty("ratio", std::to_string(ratio));
  EXPECT_LT(ratio, 0.70);
}

TEST(RoomScan, AnItemOfTheCoarseCloudTakesAtMost512Bytes) {
  const ScanToSend source{RoomScan(), ""};
  const std::int64_t count = ItemsOf(source)[ChunkKind::kCoarseCloud];
  EXPECT_EQ(count, 7);
  for (std::int64_t item = 0; item < count; ++item)
    EXPECT_LE(EncodeItem(source, {ChunkKind::kCoarseCloud, item})->size(), 512U) << item;
}

TEST(RoomScan, TheFirstCoarseCloudArrivesIn5SecondsOver9600BitsPerSecond) {
  // Header, rig, thumbnail and the first block of the cloud.
  const ScanToSend source{RoomScan(), ""};
  std::size_t bytes = 0;
  for (const ChunkKind kind :
       {ChunkKind::kHeader, ChunkKind::kRig, ChunkKind::kThumbnail, ChunkKind::kCoarseCloud})
    bytes += EncodeItem(source, {kind, 0})->size();
  EXPECT_LT(static_cast<double>(bytes) / 1200.0, 5.0);
}

TEST(RoomScan, ALosslessImageIsSmallerThanItsPng) {
  EXPECT_LT(BytesOf(ChunkKind::kImage),
            EncodePng(RoomScan().frames[0].image, PngContent::kCapture)->size());
  ScanToSend gray{RoomScan(), ""};
  gray.scan.frames.Edit(0).image = ColorOf(RedOf(gray.scan.frames[0].image));
  EXPECT_LT(EncodeItem(gray, {ChunkKind::kImage, 0})->size(),
            EncodePng(RedOf(gray.scan.frames[0].image))->size());
}

TEST(RoomScan, ThinCloudsLieWhereTheWholeScanHasItsPoints) {
  const Scan& scan = RoomScan();
  const RegisteredScan whole = RegisterScan(scan, {}).value();
  for (const ChunkKind kind : {ChunkKind::kCoarseCloud, ChunkKind::kFineCloud}) {
    const CloudStep step = kind == ChunkKind::kCoarseCloud ? kCoarseStep : kFineStep;
    ScanBuilder builder(scan.uuid);
    EXPECT_EQ(builder.Cloud().error().code, ErrorCode::kState);
    for (const Chunk& chunk : samples::AllChunks({scan, ""}))
      if (chunk.id.kind == kind || chunk.id.kind == ChunkKind::kRig) {
        ASSERT_TRUE(builder.Take(chunk));
      }
    const RegisteredScan cloud = builder.Cloud().value().points;
    int points = 0;
    for (int line = 0; line < cloud.lines; ++line)
      for (int beam = 0; beam < cloud.beams; beam += step.beams) {
        if (!cloud.Valid(line, beam)) continue;
        ++points;
        const std::size_t i = whole.Index(line * step.lines, beam);
        ASSERT_TRUE(whole.range_m[i] > 0.0f);
        // Half of 10 mm, and a motor that was not quite even within the line: 0.01 deg at 10 m.
        EXPECT_LT((cloud.points[cloud.Index(line, beam)] - whole.points[i]).norm(), 0.008f)
            << line << " " << beam;
      }
    // Every line has 136 or 541 beams, and most have a return.
    EXPECT_GT(points, cloud.lines * (1081 / step.beams) * 9 / 10);
  }
}

}  // namespace
}  // namespace foresight
