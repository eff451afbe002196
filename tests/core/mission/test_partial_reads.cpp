#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <limits>

#include "core/io/png.h"
#include "core/mission/mission_file.h"
#include "core/mission/sqlite.h"
#include "core/mission/thumbnail.h"
#include "tests/core/mission/sample_scan.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Two scans; every read is of the second one.
class PartialReads : public testing::Test {
 protected:
  PartialReads() {
    const auto mission = MissionFile::Create(path_).value();
    Record(*mission, SampleScan(1));
    id_ = Record(*mission, scan_);
    EXPECT_TRUE(mission->Close());
    reader_ = MissionFile::OpenReadOnly(path_).value();
  }

  /// Damages everything that a read must not look at.
  void Execute(const char* sql) {
    reader_.reset();
    ASSERT_TRUE(SqliteDatabase::Open(path_, SqliteDatabase::Mode::kReadWrite).value().Run(sql));
    reader_ = MissionFile::OpenReadOnly(path_).value();
  }

  TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "m.foresight";
  const Scan scan_ = SampleScan(2);
  std::int64_t id_ = 0;
  std::unique_ptr<MissionFile> reader_;
};

TEST_F(PartialReads, AHeaderIsEverythingButLinesTrackAndImages) {
  Execute(
      "UPDATE line SET data = zeroblob(9); UPDATE motor SET data = zeroblob(9); UPDATE "
      "image_data SET png = zeroblob(9)");
  Scan expected = scan_;
  expected.lines.clear();
  expected.track = {};
  expected.frames.clear();
  const Scan header = reader_->LoadHeader(id_).value();
  EXPECT_TRUE(SameButForTheRig(header, expected));
  EXPECT_EQ(header.rig.camera, scan_.rig.camera);
}

TEST_F(PartialReads, LinesFromANumberOn) {
  const auto lines = [&](std::int64_t first, std::size_t at_most) {
    return reader_->LoadLines(id_, first, at_most).value();
  };
  // Lines 7 and 8 were lost.
  EXPECT_THAT(lines(6, 2), ElementsAre(scan_.lines[6], scan_.lines[7]));
  EXPECT_THAT(lines(7, 1), ElementsAre(scan_.lines[7]));
  EXPECT_EQ(lines(0, std::numeric_limits<std::size_t>::max()), scan_.lines);
  EXPECT_THAT(lines(22, 5), IsEmpty());
}

TEST_F(PartialReads, LinesLookAtNothingElse) {
  Execute(
      "UPDATE line SET data = zeroblob(9) WHERE seq <> 12; UPDATE motor SET data = "
      "zeroblob(9); UPDATE image_data SET png = zeroblob(9)");
  EXPECT_THAT(reader_->LoadLines(id_, 12, 1).value(), ElementsAre(scan_.lines[10]));
  EXPECT_THAT(reader_->LoadLines(id_, 12, 2).error().message, HasSubstr("line 13 is damaged"));
}

TEST_F(PartialReads, TheTrackAlone) {
  Execute("UPDATE line SET data = zeroblob(9); UPDATE image_data SET png = zeroblob(9)");
  EXPECT_EQ(reader_->LoadTrack(id_).value(), scan_.track);
}

TEST_F(PartialReads, AListOfImagesNeedsNoPixels) {
  const std::vector<ImageSummary> images = reader_->ListImages(id_).value();
  ASSERT_EQ(images.size(), 2u);
  EXPECT_EQ(images[1].position, 1);
  EXPECT_EQ(images[1].seq, scan_.frames[1].seq);
  EXPECT_EQ(images[1].time_s, scan_.frames[1].time_s);
  EXPECT_EQ(images[1].exposure_s, scan_.frames[1].exposure_s);
  EXPECT_EQ(images[1].motor_angle_rad, scan_.frames[1].motor_angle_rad);
  EXPECT_EQ(images[1].target_angle_rad, scan_.frames[1].target_angle_rad);
  EXPECT_EQ(images[1].width, 41);
  EXPECT_EQ(images[1].height, 31);
  Execute("UPDATE image_data SET png = CAST(substr(png, 1, 24) AS BLOB)");
  EXPECT_EQ(reader_->ListImages(id_)->size(), 2u);
}

TEST_F(PartialReads, OneImageLeavesTheOthersAlone) {
  Execute("UPDATE image_data SET png = zeroblob(9) WHERE position = 0");
  EXPECT_EQ(reader_->LoadImage(id_, 1).value(), scan_.frames[1]);
  EXPECT_THAT(reader_->LoadImage(id_, 0).error().message, HasSubstr("scan 2, image 0 is damaged"));
}

TEST_F(PartialReads, WhatIsNotThereIsNamed) {
  EXPECT_THAT(reader_->LoadImage(id_, 2).error().message, HasSubstr("scan 2 has no image 2"));
  for (const std::int64_t id : {-1, 0, 3}) {
    const std::string none = "there is no scan " + std::to_string(id);
    EXPECT_THAT(reader_->Summary(id).error().message, HasSubstr(none));
    EXPECT_THAT(reader_->LoadHeader(id).error().message, HasSubstr(none));
    EXPECT_THAT(reader_->LoadLines(id, 0, 1).error().message, HasSubstr(none));
    EXPECT_THAT(reader_->LoadTrack(id).error().message, HasSubstr(none));
    EXPECT_THAT(reader_->ListImages(id).error().message, HasSubstr(none));
    EXPECT_EQ(reader_->LoadScan(id).error().code, ErrorCode::kInvalidInput);
  }
}

TEST_F(PartialReads, ASummaryHasAThumbnailOfTheFirstImage) {
  const ScanSummary summary = reader_->Summary(id_).value();
  const ColorImage thumbnail = DecodePng(summary.thumbnail, "thumbnail").value();
  EXPECT_EQ(thumbnail, scan_.frames[0].image);  // small enough as it is
  EXPECT_EQ(reader_->ListScans()->at(1).thumbnail, summary.thumbnail);
}

TEST_F(PartialReads, ADamagedThumbnailDoesNotHideTheList) {
  Execute("UPDATE thumbnail SET png = zeroblob(9) WHERE scan_id = 2");
  EXPECT_EQ(reader_->ListScans()->at(1).thumbnail, "");
  EXPECT_NE(reader_->ListScans()->at(0).thumbnail, "");
  EXPECT_THAT(reader_->Verify({}).error().message, HasSubstr("scan 2: its thumbnail is damaged"));
}

TEST(Thumbnail, KeepsTheShapeOfALargeImage) {
  ColorImage image(1288, 964);
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      image(x, y) = x < 644 ? Rgb8{200, 10, 10} : Rgb8{10, 10, 200};
  const std::string png = ThumbnailOf(image).value();
  EXPECT_LE(png.size(), kMaxThumbnailBytes);
  const ColorImage small = DecodePng(png, "thumbnail").value();
  EXPECT_EQ(small.width(), 128);
  EXPECT_EQ(small.height(), 95);
  EXPECT_EQ(small(0, 0), (Rgb8{200, 10, 10}));
  EXPECT_EQ(small(127, 94), (Rgb8{10, 10, 200}));
}

TEST(Thumbnail, OfPureNoiseStaysWithinItsBytes) {
  // A thumbnail averages, but not where the image is no larger than it.
  ColorImage image(128, 128);
  Random random(1);
  for (Rgb8& pixel : image.values())
    pixel = {static_cast<std::uint8_t>(random.Index(256)),
             static_cast<std::uint8_t>(random.Index(256)),
             static_cast<std::uint8_t>(random.Index(256))};
  const auto png = ThumbnailOf(image);
  ASSERT_TRUE(png) << png.error().message;
  EXPECT_LE(png->size(), kMaxThumbnailBytes);
}

TEST(Thumbnail, OfALineIsALine) {
  const ColorImage small = DecodePng(ThumbnailOf(ColorImage(5000, 1)).value(), "thumbnail").value();
  EXPECT_EQ(small.height(), 1);
}

TEST(MissionList, AHundredScansAreListedInAFifthOfASecond) {
  // 480 lines a scan, but of few beams, so that the test is quick: a list that read lines would
  // read 48,000 of them.
  const TemporaryFolder folder;
  {
    const auto mission = MissionFile::Create(folder / "m.foresight").value();
    Scan scan = SampleScan(1);
    LidarLine line;
    line.range_mm.assign(8, 1000);
    const Status recorded = mission->Batch([&]() -> Status {
      for (int i = 0; i < 100; ++i) {
        scan.uuid = "scan-" + std::to_string(i);
        FORESIGHT_TRY(const std::int64_t id, mission->BeginScan(scan));
        for (line.seq = 0; line.seq < 480; ++line.seq)
          FORESIGHT_CHECK(mission->AppendLine(id, line));
        FORESIGHT_CHECK(mission->AppendFrame(id, scan.frames[0]));
        FORESIGHT_CHECK(mission->EndScan(id, ScanState::kComplete, ""));
      }
      return {};
    });
    ASSERT_TRUE(recorded);
  }
  double least_s = 1.0;  // other programs run beside this one
  for (int i = 0; i < 10; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    const auto reader = MissionFile::OpenReadOnly(folder / "m.foresight").value();
    const std::vector<ScanSummary> scans = reader->ListScans().value();
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    least_s = std::min(least_s, seconds.count());
    ASSERT_EQ(scans.size(), 100u);
    ASSERT_EQ(scans[99].lines, 480);
  }
  EXPECT_LT(least_s, 0.2);
}

}  // namespace
}  // namespace foresight
