#include "core/mission/mission_index.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/core/mission/sample_scan.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

class MissionIndexTest : public testing::Test {
 protected:
  MissionIndexTest() {
    std::filesystem::create_directory(folder_ / "june");
    Make("a.foresight", 1, "valve", "homed");
    Make("june/b.foresight", 2, "drill", "the operator stopped the motor");
  }

  void Make(const std::string& name, std::uint64_t seed, const std::string& kind,
            const std::string& event) {
    const auto mission = MissionFile::Create(folder_ / name).value();
    const std::int64_t id = Record(*mission, SampleScan(seed));
    DetectionRecord object;
    object.scan_id = id;
    object.kind = kind;
    object.utc_ns = 1'700'000'100'000'000'000 + static_cast<std::int64_t>(seed);
    object.author = "reviewer";
    object.json = R"({"verdict":{"level":"CONFIRMED"}})";
    const std::int64_t found = mission->AddDetection(object).value();
    EXPECT_TRUE(
        mission->AddDetectionEvent(found, {44, "operator", DetectionEvent::Action::kAccepted, ""}));
    mission->AddEvent({0, 1'700'000'200'000'000'000, "head", "info", event, ""}).value();
    EXPECT_TRUE(mission->Close());
  }

  MissionHits Search(const MissionQuery& query) {
    return SearchMissions(folder_.path(), query, {}, {}).value();
  }
  static std::vector<std::string> NamesOf(const MissionHits& found) {
    std::vector<std::string> names;
    for (const MissionHit& hit : found.hits)
      names.push_back(hit.mission.filename().string() + " " + hit.what);
    return names;
  }

  TemporaryFolder folder_;
};

TEST_F(MissionIndexTest, FindsScansObjectsAndLogInAFolderAndBelowIt) {
  EXPECT_THAT(NamesOf(Search({.words = {"DRILL"}})), ElementsAre("b.foresight object"));
  EXPECT_THAT(NamesOf(Search({.words = {"stopped", "motor"}})), ElementsAre("b.foresight log"));
  EXPECT_THAT(NamesOf(Search({.what = "scan"})),
              testing::UnorderedElementsAre("a.foresight scan", "b.foresight scan"));
  EXPECT_THAT(NamesOf(Search({.kind = "valve", .decision = "accepted"})),
              ElementsAre("a.foresight object"));
  EXPECT_THAT(Search({.words = {"confirmed"}}).hits, SizeIs(2));
  EXPECT_THAT(Search({.words = {"drill", "valve"}}).hits, IsEmpty());
  EXPECT_THAT(Search({.since_utc_ns = 1'700'000'200'000'000'000}).hits, SizeIs(2)) << "the log";
  EXPECT_THAT(Search({.until_utc_ns = 1'600'000'000'000'000'000}).hits, IsEmpty());
  EXPECT_THAT(Search({.at_most = 3}).hits, SizeIs(3));
}

TEST_F(MissionIndexTest, ReadsOnlyWhatIsNewOrChanged) {
  EXPECT_EQ(Search({}).read_again, 2);
  EXPECT_EQ(Search({}).read_again, 0);
  Make("c.foresight", 3, "terrain", "homed");
  EXPECT_EQ(Search({}).read_again, 1);
  const auto mission = MissionFile::Open(folder_ / "a.foresight").value();
  mission->AddEvent({0, 9, "operator", "info", "looked again", ""}).value();
  const MissionHits while_recording = Search({.words = {"looked"}});
  EXPECT_THAT(while_recording.hits, SizeIs(1)) << "also of a mission that is being recorded";
  ASSERT_TRUE(mission->Close());
  std::filesystem::remove(folder_ / "june/b.foresight");
  EXPECT_THAT(Search({.words = {"drill"}}).hits, IsEmpty());
  EXPECT_EQ(Search({}).missions, 2);
}

TEST_F(MissionIndexTest, AnIndexThatIsLostOrDamagedIsMadeAgain) {
  const MissionHits before = Search({});
  std::filesystem::remove(folder_ / ".foresight-index");
  EXPECT_EQ(Search({}).hits, before.hits);
  std::ofstream(folder_ / ".foresight-index") << "no database";
  const MissionHits after = Search({});
  EXPECT_EQ(after.hits, before.hits);
  EXPECT_EQ(after.read_again, 2);
}

TEST_F(MissionIndexTest, ADamagedMissionIsNamedAndTheOthersAreFound) {
  std::ofstream(folder_ / "torn.foresight") << "garbage";
  for (int time = 0; time < 2; ++time) {
    const MissionHits found = Search({.what = "scan"});
    EXPECT_THAT(found.hits, SizeIs(2));
    EXPECT_THAT(found.unreadable, ElementsAre(HasSubstr("torn.foresight")));
  }
}

TEST_F(MissionIndexTest, AFolderThatIsNotThereIsAnIoError) {
  const auto found = SearchMissions(folder_ / "none", {}, {}, {});
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::kIo);
}

}  // namespace
}  // namespace foresight
