#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/atomic_file.h"
#include "core/mission/migrations.h"
#include "core/mission/mission_file.h"
#include "core/mission/mission_schema.h"
#include "tests/core/mission/sample_scan.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

using testing::HasSubstr;

/// A copy of the golden mission of format 1 that may be written.
class Migrations : public testing::Test {
 protected:
  Migrations() {
    std::filesystem::copy_file(
        std::filesystem::path(FORESIGHT_SOURCE_DIR) / "tests/core/mission/golden/format1.foresight",
        path_);
    std::filesystem::permissions(path_, std::filesystem::perms::owner_write,
                                 std::filesystem::perm_options::add);
  }

  std::int64_t Format() const {
    return SqliteDatabase::Open(path_, SqliteDatabase::Mode::kReadOnly)
        .value()
        .Integer("PRAGMA user_version")
        .value();
  }

  void Execute(const char* sql) {
    ASSERT_TRUE(SqliteDatabase::Open(path_, SqliteDatabase::Mode::kReadWrite).value().Run(sql));
  }

  TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "old.foresight";
};

TEST_F(Migrations, LeadFromFormat1ToThePresentOneWithoutAGap) {
  int format = 1;
  for (const MissionMigration& migration : MissionMigrations()) EXPECT_EQ(migration.from, format++);
  EXPECT_EQ(format, kMissionFormatVersion);
}

TEST_F(Migrations, AReaderLeavesAnOldFileAsItIs) {
  const std::string before = ReadFile(path_).value();
  {
    const auto reader = MissionFile::OpenReadOnly(path_).value();
    EXPECT_EQ(reader->ListDetections()->size(), 3u);
    EXPECT_TRUE(reader->Verify({}));
  }
  EXPECT_EQ(ReadFile(path_).value(), before);
}

TEST_F(Migrations, AWriterBringsItToThePresentFormatAndLosesNothing) {
  const auto old = MissionFile::OpenReadOnly(path_).value();
  const auto scans = old->ListScans().value();
  const auto detections = old->ListDetections().value();
  const auto events = old->ListEvents().value();
  const Scan scan = old->LoadScan(1).value();
  ASSERT_TRUE(old->Close());

  const auto mission = MissionFile::Open(path_).value();
  EXPECT_EQ(mission->ListDetections().value(), detections);
  EXPECT_EQ(mission->ListEvents().value(), events);
  EXPECT_TRUE(SameButForTheRig(mission->LoadScan(1).value(), scan));
  EXPECT_EQ(mission->ListScans()->size(), scans.size());
  EXPECT_EQ(mission->ListScans()->at(0).objects, 3);
  EXPECT_TRUE(mission->Verify({}));
  ASSERT_TRUE(
      mission->AddDetectionEvent(1, {5, "operator", DetectionEvent::Action::kAccepted, ""}));
  ASSERT_TRUE(mission->Close());
  EXPECT_EQ(Format(), kMissionFormatVersion);
  EXPECT_EQ(MissionFile::OpenReadOnly(path_).value()->ListDetections()->at(0).decision,
            Decision::kAccepted);
}

TEST_F(Migrations, AReaderThatWasOpenFollowsTheFileToItsNewFormat) {
  const auto reader = MissionFile::OpenReadOnly(path_).value();
  const auto before = reader->ListDetections().value();
  const auto mission = MissionFile::Open(path_).value();
  EXPECT_EQ(reader->ListDetections().value(), before);
  EXPECT_EQ(reader->ListScans()->at(0).objects, 3);
}

TEST_F(Migrations, AMigratedMissionTakesMoreScans) {
  const auto mission = MissionFile::Open(path_).value();
  const std::int64_t id = Record(*mission, SampleScan(1));
  EXPECT_EQ(id, 3);
  EXPECT_NE(mission->Summary(id)->thumbnail, "");
}

TEST_F(Migrations, AnExportOfAnOldFileIsAnOldFile) {
  const auto reader = MissionFile::OpenReadOnly(path_).value();
  ASSERT_TRUE(reader->ExportTo(folder_ / "copy.foresight"));
  EXPECT_EQ(MissionFile::OpenReadOnly(folder_ / "copy.foresight").value()->ListDetections().value(),
            reader->ListDetections().value());
}

TEST_F(Migrations, ANewerFormatIsRefusedInWords) {
  Execute("PRAGMA user_version = 5");
  const std::string words =
      "was written by a newer Foresight (mission format 5; this program reads up to 4): update "
      "this program";
  EXPECT_THAT(MissionFile::OpenReadOnly(path_).error().message, HasSubstr(words));
  EXPECT_THAT(MissionFile::Open(path_).error().message, HasSubstr(words));
  EXPECT_EQ(Format(), 5);
}

TEST_F(Migrations, ADamagedRowStopsTheMigrationAndTheFileStaysAsItWas) {
  Execute("UPDATE detection SET json = 'x' WHERE id = 2");
  const auto mission = MissionFile::Open(path_);
  ASSERT_FALSE(mission);
  EXPECT_EQ(mission.error().code, ErrorCode::kBadData);
  EXPECT_THAT(mission.error().message, HasSubstr("cannot be brought from mission format 1 to 2"));
  EXPECT_THAT(mission.error().message, HasSubstr("detection 2 is damaged"));
  EXPECT_EQ(Format(), 1);
  EXPECT_EQ(MissionFile::OpenReadOnly(path_).value()->LoadScan(1)->lines.size(), 60u);
}

TEST_F(Migrations, TheTablesOfAnotherFormatAreNamed) {
  Execute("PRAGMA user_version = 2");
  EXPECT_THAT(MissionFile::OpenReadOnly(path_).error().message,
              HasSubstr("table 'detection' is not one of mission format 2"));
}

}  // namespace
}  // namespace foresight
