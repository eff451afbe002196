#include "ui/viewmodels/side_results_model.h"

#include <gtest/gtest.h>

#include <QFile>
#include <QTemporaryDir>

#include "core/mission/side_result.h"
#include "tests/ui/synthetic_scan.h"
#include "tests/ui/wait_for.h"
#include "ui/viewmodels/mission_objects.h"

namespace foresight {
namespace {

struct SideResultsModelTest : testing::Test {
  QTemporaryDir folder;
  QString path = folder.filePath("m.foresight");
  Scan scan = WallAndValveScan({.from_rad = -0.05, .to_rad = 0.05, .speed_rad_s = 0.15});
  TaskQueue tasks;
  SessionModel session{SessionMode::kReplay, &tasks};
  DepthViewModel depth{&session};
  FitViewModel fit{&session};
  CompareViewModel compare{&session, &depth};
  ReviewViewModel review{&session};
  SideResultsModel results{&review, &session, &depth, &fit, &compare};
  std::vector<Notice> notices;

  SideResultsModelTest() {
    QObject::connect(&session, &SessionModel::noticed,
                     [this](const Notice& notice) { notices.push_back(notice); });
    Write(path, scan);
    review.Open(path);
    EXPECT_TRUE(WaitFor([this] { return tasks.Idle() && results.Rows().size() == 1; }));
  }
  static void Write(const QString& file, const Scan& scan) {
    const auto mission = MissionFile::Create(file.toStdString());
    EXPECT_TRUE(mission && AppendScan(mission->get(), scan, {}) && (*mission)->Close());
  }
  bool Settled() {
    return WaitFor([this] { return tasks.Idle(); }, 60'000);
  }
  std::size_t Kept() const {
    const auto file = MissionFile::FindReviewOf(path.toStdString());
    if (!file || *file == nullptr) return 0;
    return ListSideResults(**file)->size();
  }
};

TEST_F(SideResultsModelTest, WithoutAMissionUnderReviewNothingIsRun) {
  SessionModel live{SessionMode::kLive, &tasks};
  DepthViewModel live_depth{&live};
  FitViewModel live_fit{&live};
  CompareViewModel live_compare{&live, &live_depth};
  ReviewViewModel nothing{&live};
  SideResultsModel model{&nothing, &live, &live_depth, &live_fit, &live_compare};
  EXPECT_TRUE(model.WhyNoRun().contains("Ctrl+O"));
  model.RunAgain("x");
  EXPECT_FALSE(model.Runner()->Busy());
}

TEST_F(SideResultsModelTest, ARunWithoutANameGetsOneAndIsListedBesideTheOriginal) {
  ASSERT_EQ(results.Rows()[0].name, "Original");
  results.RunAgain("  ");
  results.RunAgain("mine");
  ASSERT_TRUE(Settled());
  ASSERT_TRUE(WaitFor([this] { return results.Rows().size() == 3; }))
      << (notices.empty() ? "nothing was said" : notices.back().what.toStdString());
  EXPECT_EQ(results.Rows()[1].name, "Run 1");
  EXPECT_EQ(results.Rows()[2].name, "mine");
  EXPECT_FALSE(results.Rows()[1].author.isEmpty());
  EXPECT_TRUE(results.Rows()[1].time.isValid());
  EXPECT_EQ(results.Rows()[1].differences, "");  // the default's options
  EXPECT_EQ(Kept(), 2u);
}

TEST_F(SideResultsModelTest, ARenamedAndADeletedOneComeBackByUndo) {
  results.RunAgain("mine");
  ASSERT_TRUE(WaitFor([this] { return results.Rows().size() == 2 && tasks.Idle(); }, 60'000));
  EXPECT_FALSE(results.CanChange(0)) << "the original";
  results.Rename(1, " better ");
  ASSERT_TRUE(WaitFor([this] { return results.Rows()[1].name == "better"; }));
  results.Delete(1);
  ASSERT_TRUE(WaitFor([this] { return results.Rows().size() == 1; }));
  EXPECT_EQ(Kept(), 0u);
  session.Undo()->undo();
  ASSERT_TRUE(WaitFor([this] { return results.Rows().size() == 2; }));
  session.Undo()->undo();
  ASSERT_TRUE(WaitFor([this] { return results.Rows()[1].name == "mine"; }));
  session.Undo()->redo();
  ASSERT_TRUE(WaitFor([this] { return results.Rows()[1].name == "better"; }));
  results.Delete(0);
  results.Rename(0, "x");
  ASSERT_TRUE(Settled());
  EXPECT_EQ(results.Rows()[0].name, "Original");
}

TEST_F(SideResultsModelTest, ADeletedOneIsComparedNoLonger) {
  results.RunAgain("mine");
  ASSERT_TRUE(WaitFor([this] { return results.Rows().size() == 2 && tasks.Idle(); }, 60'000));
  results.ChooseB(1);
  ASSERT_TRUE(Settled());
  results.Delete(1);
  ASSERT_TRUE(WaitFor([this] { return results.Rows().size() == 1; }));
  EXPECT_EQ(results.B(), -1);
  EXPECT_FALSE(results.WhyNoComparison().isEmpty());
}

TEST_F(SideResultsModelTest, ACancelledRunKeepsNothing) {
  results.RunAgain("never");
  results.Runner()->cancel();
  ASSERT_TRUE(Settled());
  EXPECT_EQ(Kept(), 0u);
  EXPECT_EQ(results.Rows().size(), 1u);
}

TEST_F(SideResultsModelTest, ARunBelongsToItsMissionWhateverIsOpenedMeanwhile) {
  Scan other = scan;
  other.uuid = NewUuid();
  const QString file = folder.filePath("other.foresight");
  Write(file, other);
  results.RunAgain("mine");
  review.Open(file);
  ASSERT_TRUE(WaitFor([&] { return review.Path() == file && tasks.Idle(); }, 60'000));
  ASSERT_TRUE(WaitFor([this] { return Kept() == 1; }, 10'000)) << "in the mission it was begun in";
  const auto beside_other = MissionFile::FindReviewOf(file.toStdString());
  ASSERT_TRUE(beside_other);
  EXPECT_EQ(*beside_other, nullptr) << "not in the one that is open";
  ASSERT_EQ(results.Rows().size(), 1u);
  EXPECT_EQ(results.Rows()[0].scan, other.uuid);
}

TEST_F(SideResultsModelTest, ARigFileThatIsNoneIsNamedAndNothingIsKept) {
  const QString rig = folder.filePath("rig.yaml");
  QFile file(rig);
  ASSERT_TRUE(file.open(QIODevice::WriteOnly) && file.write("no rig\n") > 0);
  file.close();
  results.RunAgainWithRig("x", rig);
  ASSERT_TRUE(Settled());
  ASSERT_FALSE(notices.empty());
  EXPECT_TRUE(notices.back().what.contains("rig.yaml")) << notices.back().what.toStdString();
  EXPECT_EQ(Kept(), 0u);
}

TEST_F(SideResultsModelTest, AAndBAreComparedAsSoonAsBothAreChosen) {
  EXPECT_FALSE(results.WhyNoComparison().isEmpty());
  results.ChooseB(0);
  ASSERT_TRUE(Settled());
  ASSERT_NE(results.Last().comparison, nullptr);
  EXPECT_EQ(results.Last().comparison->depth->max_abs_m, 0.0);
  EXPECT_EQ(compare.With(), CompareViewModel::Kind::kResults);
  EXPECT_TRUE(compare.FirstTitle().startsWith("A: "));
}

TEST_F(SideResultsModelTest, AScanOfAnotherMissionIsListedAndComparedByItsCloud) {
  Scan other = WallAndValveScan({.from_rad = -0.04, .to_rad = 0.06, .speed_rad_s = 0.15});
  other.uuid = NewUuid();
  const QString file = folder.filePath("other.foresight");
  Write(file, other);
  results.AddMission(file);
  ASSERT_TRUE(WaitFor([this] { return results.Rows().size() == 2 && tasks.Idle(); }));
  EXPECT_EQ(results.Rows()[1].name, "other.foresight, scan 1");
  results.ChooseB(1);
  ASSERT_TRUE(Settled());
  ASSERT_NE(results.Last().comparison, nullptr);
  EXPECT_FALSE(results.Last().comparison->depth);
  EXPECT_GT(results.Last().comparison->lidar->from_first.points, 100u);
  EXPECT_EQ(compare.With(), CompareViewModel::Kind::kNothing);
}

}  // namespace
}  // namespace foresight
