#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <fstream>

#include "core/base/atomic_file.h"
#include "core/mission/mission_damage.h"
#include "core/mission/salvage_mission.h"
#include "tests/core/mission/sample_scan.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr std::size_t kAll = 1'000'000;

class FindDamageTest : public testing::Test {
 protected:
  FindDamageTest() {
    const auto mission = MissionFile::Create(path_).value();
    for (const std::uint64_t seed : {1, 2}) {
      const std::int64_t id = Record(*mission, SampleScan(seed));
      DetectionRecord detection;
      detection.scan_id = id;
      detection.kind = "valve";
      detection.json = R"({"score":0.9})";
      mission->AddDetection(detection).value();
      DepthRecord depth;
      depth.scan_id = id;
      depth.digest = "0123";
      mission->AddDepth(depth).value();
    }
    mission->AddEvent({0, 43, "head", "info", "homed", ""}).value();
    EXPECT_TRUE(mission->Close());
    good_ = ReadFile(path_).value();
  }

  void Execute(const std::string& sql) {
    sqlite3* connection = nullptr;
    ASSERT_EQ(sqlite3_open(path_.c_str(), &connection), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(connection, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK)
        << sqlite3_errmsg(connection);
    sqlite3_close(connection);
  }

  void Write(const std::string& bytes) { std::ofstream(path_, std::ios::binary) << bytes; }

  DamageReport Find(std::size_t at_most = kAll) { return FindDamage(path_, at_most, {}).value(); }

  std::vector<std::string> Named(std::size_t at_most = kAll) {
    std::vector<std::string> words;
    for (const DamagedRecord& record : Find(at_most).records) words.push_back(InWords(record));
    return words;
  }

  /// Damage at random places: whatever costs recover something is named here too, and what is
  /// whole is not.
  void DamageAndFind(std::uint64_t first_seed, int runs) {
    int damaged = 0;
    for (int run = 0; run < runs; ++run) {
      const std::uint64_t seed = first_seed + static_cast<std::uint64_t>(run);
      Random random(seed);
      std::string bytes = good_;
      const auto at = static_cast<std::size_t>(random.Index(static_cast<int>(bytes.size())));
      const std::size_t length = seed % 5 == 0 ? 4096 : 1;  // a torn write, or a flipped byte
      for (std::size_t i = at; i < std::min(bytes.size(), at + length); ++i)
        bytes[i] = static_cast<char>(bytes[i] ^ (1 + random.Index(255)));
      if (seed % 7 == 0) bytes.resize(at);
      Write(bytes);
      const auto report = FindDamage(path_, kAll, {});
      const auto saved = SalvageMission(path_, folder_ / "saved.foresight", {}, {});
      if (!report) {
        ASSERT_EQ(report.error().code, ErrorCode::kBadData) << "seed " << seed;
        ASSERT_FALSE(saved) << "seed " << seed << ": " << report.error().message;
        continue;
      }
      if (report->count > 0) ++damaged;
      ASSERT_LT(report->count, 100u) << "seed " << seed << ": more than the file has";
      if (saved && !saved->losses.empty()) {
        ASSERT_GT(report->count, 0u) << "seed " << seed << ": " << saved->losses.front();
      }
    }
    EXPECT_GT(damaged, runs / 6);
  }

  TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "m.foresight";
  std::string good_;
};

TEST_F(FindDamageTest, AWholeMissionHasNone) {
  EXPECT_EQ(Find().count, 0u);
  EXPECT_THAT(Find().records, IsEmpty());
}

TEST_F(FindDamageTest, EveryDamagedRecordIsNamedNotOnlyTheFirst) {
  Execute("UPDATE line SET data = zeroblob(100) WHERE scan_id = 1 AND seq IN (3, 9)");
  Execute("UPDATE motor SET batch = batch, crc32 = 1 WHERE scan_id = 2 AND batch = 1");
  Execute("UPDATE image SET gain_db = 1 WHERE scan_id = 2 AND position = 0");
  Execute("UPDATE image_data SET png = x'00' WHERE scan_id = 1 AND position = 1");
  Execute("UPDATE detection SET kind = 'drill' WHERE id = 2");
  Execute("UPDATE event SET text = 'x'");
  const auto named = Named();
  for (const char* record :
       {"scan 1, line 3: its checksum", "scan 1, line 9: its checksum",
        "scan 2, motor samples 1: its checksum", "scan 2, image 0: its checksum",
        "scan 1, image 1: its pixels: its checksum", "detection 2: its checksum",
        "event 1: its checksum"})
    EXPECT_THAT(named, Contains(HasSubstr(record)));
  EXPECT_THAT(named, SizeIs(7));
}

TEST_F(FindDamageTest, WhatIsMissingIsCounted) {
  Execute("DELETE FROM line WHERE scan_id = 2 AND seq IN (0, 1, 2)");
  Execute("UPDATE line SET time_s = 0 WHERE scan_id = 2 AND seq = 4");
  EXPECT_THAT(Named(), ElementsAre(HasSubstr("scan 2, line 4: its checksum"),
                                   HasSubstr("scan 2: 3 of 20 lines are missing")));
}

TEST_F(FindDamageTest, AListIsBoundedAndSaysHowManyThereAre) {
  Execute("UPDATE line SET time_s = 0");
  const DamageReport report = Find(5);
  EXPECT_THAT(report.records, SizeIs(5));
  EXPECT_EQ(report.count, 40u);
}

TEST_F(FindDamageTest, WhatContradictsItselfWithGoodChecksumsIsNamed) {
  Execute("DELETE FROM calibration");
  EXPECT_THAT(Named(), testing::Not(IsEmpty()));
}

TEST_F(FindDamageTest, AMissionWithoutItsTableOfContentsIsReadPageByPage) {
  Execute("UPDATE line SET data = zeroblob(1000) WHERE scan_id = 1 AND seq = 9");
  std::string bytes = ReadFile(path_).value();
  std::fill_n(bytes.begin(), 8192, '\xa5');
  Write(bytes);
  EXPECT_THAT(Named(), ElementsAre(HasSubstr("is not a mission file"),
                                   HasSubstr("scan 1, line 9: its checksum")));
}

TEST_F(FindDamageTest, OfACutFileWhatIsLostIsCounted) {
  Write(good_.substr(0, good_.size() / 2 / 8192 * 8192));
  EXPECT_THAT(Named(), Contains(HasSubstr("are missing")));
}

TEST_F(FindDamageTest, SomethingElseIsNoDamagedMission) {
  Write(std::string(70000, '\x0d'));
  EXPECT_THAT(FindDamage(path_, kAll, {}).error().message, HasSubstr("is not a mission file"));
}

TEST_F(FindDamageTest, WhereverAFileIsDamagedItIsNamed) {
  DamageAndFind(0, 10);
}

TEST_F(FindDamageTest, AtAThousandPlacesToo) {
  DamageAndFind(1000, 1000);
}

}  // namespace
}  // namespace foresight
