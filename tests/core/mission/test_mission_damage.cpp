#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <fstream>

#include "core/base/atomic_file.h"
#include "core/mission/mission_file.h"
#include "tests/core/mission/sample_scan.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

using testing::HasSubstr;

/// All that a mission holds.
struct Contents {
  std::vector<Scan> scans;
  std::vector<DetectionRecord> detections;
  std::vector<DepthRecord> depths;
  std::vector<EventRecord> events;

  bool operator==(const Contents& other) const {
    return scans.size() == other.scans.size() &&
           std::equal(scans.begin(), scans.end(), other.scans.begin(), SameButForTheRig) &&
           detections == other.detections && depths == other.depths && events == other.events;
  }
};

Result<Contents> ReadAll(const std::filesystem::path& path) {
  Contents contents;
  FORESIGHT_TRY(const auto mission, MissionFile::OpenReadOnly(path));
  FORESIGHT_TRY(const auto summaries, mission->ListScans());
  for (const ScanSummary& summary : summaries) {
    FORESIGHT_TRY(Scan scan, mission->LoadScan(summary.id));
    contents.scans.push_back(std::move(scan));
  }
  FORESIGHT_TRY(contents.detections, mission->ListDetections());
  FORESIGHT_TRY(contents.depths, mission->ListDepths());
  FORESIGHT_TRY(contents.events, mission->ListEvents());
  return contents;
}

class MissionDamage : public testing::Test {
 protected:
  MissionDamage() {
    const auto mission = MissionFile::Create(folder_ / "good.mission").value();
    const std::int64_t id = Record(*mission, SampleScan(1));
    DetectionRecord detection;
    detection.scan_id = id;
    detection.kind = "valve";
    detection.json = R"({"score":0.9})";
    const std::int64_t found = mission->AddDetection(detection).value();
    EXPECT_TRUE(mission->AddDetectionEvent(
        found, {44, "operator", DetectionEvent::Action::kAccepted, "looks right"}));
    DepthRecord depth;
    depth.scan_id = id;
    depth.digest = "0123";
    mission->AddDepth(depth).value();
    mission->AddEvent({0, 43, "head", "info", "homed", ""}).value();
    EXPECT_TRUE(mission->Close());
    good_ = ReadFile(folder_ / "good.mission").value();
    contents_ = ReadAll(folder_ / "good.mission").value();
  }

  /// Reads the mission with other bytes; every error must be clear.
  Result<Contents> ReadWith(const std::string& bytes) {
    std::ofstream(folder_ / "bad.mission", std::ios::binary) << bytes;
    auto contents = ReadAll(folder_ / "bad.mission");
    if (!contents) {
      EXPECT_EQ(contents.error().code, ErrorCode::kBadData) << contents.error().message;
      EXPECT_THAT(contents.error().message, HasSubstr("bad.mission"));
    }
    return contents;
  }

  void Execute(const char* sql) {
    sqlite3* connection = nullptr;
    ASSERT_EQ(sqlite3_open((folder_ / "good.mission").c_str(), &connection), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(connection, sql, nullptr, nullptr, nullptr), SQLITE_OK)
        << sqlite3_errmsg(connection);
    sqlite3_close(connection);
  }

  std::string ErrorAfter(const char* sql) {
    Execute(sql);
    const auto contents = ReadAll(folder_ / "good.mission");
    return contents ? "no error" : contents.error().message;
  }

  TemporaryFolder folder_;
  std::string good_;
  Contents contents_;
};

TEST_F(MissionDamage, ACutFileIsAlwaysAClearError) {
  Random random(1);
  for (int i = 0; i < 50; ++i) {
    const auto length = static_cast<std::size_t>(random.Index(static_cast<int>(good_.size())));
    EXPECT_FALSE(ReadWith(good_.substr(0, length))) << length << " of " << good_.size();
  }
}

TEST_F(MissionDamage, ADamagedByteIsAClearErrorOrChangesNothing) {
  int errors = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    Random random(seed);
    std::string bytes = good_;
    // A third of them in the first page: header and schema.
    const int reach = seed % 3 == 0 ? 4096 : static_cast<int>(good_.size());
    const auto at = static_cast<std::size_t>(random.Index(reach));
    bytes[at] = static_cast<char>(bytes[at] ^ (1 + random.Index(255)));
    const auto contents = ReadWith(bytes);
    if (!contents) ++errors;
    if (contents) {
      EXPECT_EQ(*contents, contents_) << "byte " << at;
    }
  }
  // Two thirds of so small a file are free space; with none at all nothing would have been tested.
  EXPECT_GT(errors, 20);
}

TEST_F(MissionDamage, EveryByteOfTheHeaderMayBeDamaged) {
  int errors = 0;
  for (std::size_t at = 0; at < 100; ++at)
    for (const int flip : {1, 0x80, 0xff}) {
      std::string bytes = good_;
      bytes[at] = static_cast<char>(bytes[at] ^ flip);
      const auto contents = ReadWith(bytes);
      if (!contents) ++errors;
      if (contents) {
        EXPECT_EQ(*contents, contents_) << "byte " << at;
      }
    }
  EXPECT_GT(errors, 20) << "the magic words and sizes are looked at";
}

TEST_F(MissionDamage, OverwrittenBlocksAreAClearErrorOrChangeNothing) {
  int errors = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Random random(seed);
    std::string bytes = good_;
    const auto at = static_cast<std::size_t>(random.Index(static_cast<int>(good_.size()) - 600));
    for (std::size_t i = 0; i < 600; ++i) bytes[at + i] = static_cast<char>(random.Index(256));
    const auto contents = ReadWith(bytes);
    if (!contents) ++errors;
    if (contents) {
      EXPECT_EQ(*contents, contents_) << "byte " << at;
    }
  }
  EXPECT_GT(errors, 10);
}

TEST_F(MissionDamage, WhatIsNoDatabaseIsCalledThat) {
  for (const std::string bytes : {"", "hello", "SQLite format 3"})
    EXPECT_THAT(ReadWith(bytes).error().message, HasSubstr("is not a mission file")) << bytes;
  EXPECT_FALSE(ReadWith(std::string(100000, 'x')));
}

TEST_F(MissionDamage, AMissingFileAndAFolderAreIoErrors) {
  EXPECT_EQ(MissionFile::Open(folder_ / "none").error().code, ErrorCode::kIo);
  EXPECT_EQ(MissionFile::OpenReadOnly(folder_.path()).error().code, ErrorCode::kIo);
}

TEST_F(MissionDamage, AnotherProgramsDatabaseIsNotAMission) {
  EXPECT_THAT(ErrorAfter("PRAGMA application_id = 7"), HasSubstr("is not a mission file"));
}

TEST_F(MissionDamage, ANewerFormatIsRefusedAndLeftAsItIs) {
  Execute("PRAGMA user_version = 99");
  const std::string before = ReadFile(folder_ / "good.mission").value();
  const auto opened = MissionFile::Open(folder_ / "good.mission");
  ASSERT_FALSE(opened);
  EXPECT_THAT(opened.error().message, HasSubstr("was written by a newer Foresight"));
  EXPECT_EQ(ReadFile(folder_ / "good.mission").value(), before);
}

TEST_F(MissionDamage, AStrangeTableIsNamed) {
  EXPECT_THAT(ErrorAfter("CREATE TABLE extra(a)"), HasSubstr("table 'extra' is not one of"));
}

TEST_F(MissionDamage, AMissingLineIsNoticed) {
  EXPECT_THAT(ErrorAfter("DELETE FROM line WHERE seq = 4"),
              HasSubstr("scan 1: 19 lines of 20 are there"));
}

TEST_F(MissionDamage, ALineUnderAnotherNumberIsNoticed) {
  EXPECT_THAT(ErrorAfter("UPDATE line SET seq = 7 WHERE seq = 4"),
              HasSubstr("scan 1, line 7 is damaged"));
}

TEST_F(MissionDamage, AMissingRigIsNoticed) {
  EXPECT_THAT(ErrorAfter("DELETE FROM calibration"), HasSubstr("calibration 1 is missing"));
}

TEST_F(MissionDamage, AMissingImageIsNoticed) {
  EXPECT_THAT(ErrorAfter("DELETE FROM image_data WHERE position = 1"),
              HasSubstr("scan 1, image 1 is damaged"));
}

TEST_F(MissionDamage, NegativeCountsAreNoticed) {
  EXPECT_THAT(ErrorAfter("UPDATE scan SET lines = -5"), HasSubstr("scan 1: its row is damaged"));
}

TEST_F(MissionDamage, VerifyFindsADamagedImage) {
  Execute("UPDATE image_data SET png = zeroblob(10) WHERE position = 0");
  const auto mission = MissionFile::OpenReadOnly(folder_ / "good.mission").value();
  EXPECT_THAT(mission->Verify({}).error().message, HasSubstr("scan 1, image 0 is damaged"));
}

TEST_F(MissionDamage, VerifyPassesAGoodFile) {
  EXPECT_TRUE(MissionFile::OpenReadOnly(folder_ / "good.mission").value()->Verify({}));
}

}  // namespace
}  // namespace foresight
