// Several missions open for review at once.
#include <gtest/gtest.h>

#include "tests/review/mission_for_review.h"
#include "tests/ui/wait_for.h"
#include "ui/viewmodels/review_view_model.h"

namespace foresight {
namespace {

struct OpenMissionsTest : testing::Test {
  MissionForReview mission;
  QString other = mission.MakeAnother(QStringLiteral("other.foresight"));
  TaskQueue tasks;
  SessionModel session{SessionMode::kReplay, &tasks};
  ReviewViewModel review{&session};
  std::vector<Notice> notices;

  OpenMissionsTest() {
    QObject::connect(&session, &SessionModel::noticed,
                     [this](const Notice& notice) { notices.push_back(notice); });
  }
  bool Settled() {
    return WaitFor([&] { return !review.Busy(); });
  }
};

TEST_F(OpenMissionsTest, SeveralAreOpenedAtOnceAndTheLastOneIsShown) {
  review.OpenAll({mission.Path(), other});
  ASSERT_TRUE(Settled());
  ASSERT_EQ(review.Missions().size(), 2u);
  EXPECT_EQ(review.Missions()[0].scans.size(), 2u);
  EXPECT_EQ(review.MissionIndex(), 1);
  EXPECT_EQ(review.Path(), other);
  EXPECT_EQ(session.CurrentScan()->uuid, mission.Second().uuid);
}

TEST_F(OpenMissionsTest, AnotherOneStaysOpenWhenOneIsOpened) {
  review.Open(mission.Path(), mission.First().uuid);
  ASSERT_TRUE(Settled());
  review.Open(other);
  ASSERT_TRUE(Settled());
  EXPECT_EQ(review.Missions().size(), 2u);
  review.ShowScanOf(0, 0);
  ASSERT_TRUE(Settled());
  EXPECT_EQ(review.Path(), mission.Path());
  EXPECT_EQ(session.CurrentScan()->uuid, mission.First().uuid);
  EXPECT_EQ(session.Objects().size(), 1u);
}

TEST_F(OpenMissionsTest, OneThatIsOpenIsNotOpenedASecondTime) {
  review.Open(mission.Path());
  ASSERT_TRUE(Settled());
  const auto file = review.File();
  review.Open(mission.Path(), mission.First().uuid, MissionForReview::kValve);
  ASSERT_TRUE(Settled());
  EXPECT_EQ(review.Missions().size(), 1u);
  EXPECT_EQ(review.File(), file);
  EXPECT_EQ(session.CurrentScan()->uuid, mission.First().uuid);
  ASSERT_NE(session.Selected(), nullptr);
  EXPECT_EQ(session.Selected()->uuid, MissionForReview::kValve);
}

TEST_F(OpenMissionsTest, ClosingTheOneThatIsShownShowsAnother) {
  review.OpenAll({mission.Path(), other});
  ASSERT_TRUE(Settled());
  review.close();
  ASSERT_TRUE(Settled());
  EXPECT_EQ(review.Missions().size(), 1u);
  EXPECT_EQ(review.Path(), mission.Path());
  ASSERT_NE(session.CurrentScan(), nullptr);
  EXPECT_EQ(session.CurrentScan()->uuid, mission.Second().uuid);
  review.close();
  EXPECT_TRUE(review.Missions().empty());
  EXPECT_TRUE(review.Path().isEmpty());
  EXPECT_EQ(session.CurrentScan(), nullptr);
}

TEST_F(OpenMissionsTest, ClosingAnotherOneLeavesWhatIsShown) {
  review.OpenAll({mission.Path(), other});
  ASSERT_TRUE(Settled());
  const auto scan = session.CurrentScan();
  review.CloseMission(0);
  ASSERT_TRUE(Settled());
  EXPECT_EQ(review.MissionIndex(), 0);
  EXPECT_EQ(review.Path(), other);
  EXPECT_EQ(session.CurrentScan(), scan);
}

TEST_F(OpenMissionsTest, WhatIsDecidedIsKeptBesideItsOwnMission) {
  review.OpenAll({other, mission.Path()});
  ASSERT_TRUE(Settled());
  review.showScan(0);
  ASSERT_TRUE(Settled());
  session.SelectObject(0);
  session.Decide(Decision::kRejected);
  ASSERT_TRUE(Settled());
  const auto beside = [](const QString& path) {
    return MissionFile::ReviewPathOf(path.toStdString()).value();
  };
  EXPECT_TRUE(std::filesystem::exists(beside(mission.Path())));
  EXPECT_FALSE(std::filesystem::exists(beside(other)));
}

TEST_F(OpenMissionsTest, OneThatCannotBeOpenedIsNamedAndTheOthersAreOpen) {
  review.OpenAll({mission.Path(), mission.Folder() + "/missing.foresight", other});
  ASSERT_TRUE(Settled());
  EXPECT_EQ(review.Missions().size(), 2u);
  ASSERT_EQ(notices.size(), 1u);
  EXPECT_TRUE(notices[0].what.contains(QStringLiteral("missing.foresight")));
}

}  // namespace
}  // namespace foresight
