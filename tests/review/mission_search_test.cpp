#include "ui/viewmodels/mission_search_model.h"

#include <gtest/gtest.h>

#include "tests/review/mission_for_review.h"
#include "tests/ui/wait_for.h"

namespace foresight {
namespace {

struct MissionSearchTest : testing::Test {
  MissionForReview mission;
  TaskQueue tasks;
  SessionModel session{SessionMode::kReplay, &tasks};
  ReviewViewModel review{&session};
  MissionSearchModel search{&review, &tasks, mission.Folder()};

  bool Settled() {
    return WaitFor([&] { return !search.Busy() && !review.Busy(); });
  }
  void Type(const QString& text) {
    const int before = searches;
    const auto counting = QObject::connect(&search, &MissionSearchModel::changed, [this] {
      if (!search.Busy()) ++searches;
    });
    search.SetText(text);
    EXPECT_TRUE(WaitFor([&] { return searches > before; }));
    QObject::disconnect(counting);
  }
  int searches = 0;
};

TEST_F(MissionSearchTest, TypingFindsAnObjectInTheFolder) {
  Type(QStringLiteral("valve  accepted"));
  ASSERT_EQ(search.Hits().size(), 1u);
  EXPECT_EQ(search.Hits()[0].scan_uuid, mission.First().uuid);
  EXPECT_EQ(search.Summary().toStdString(), "1 found in 1 missions");
}

TEST_F(MissionSearchTest, OpeningWhatWasFoundShowsThatScanForReview) {
  Type(QStringLiteral("accepted"));
  ASSERT_EQ(search.Hits().size(), 1u);
  search.Open(0);
  ASSERT_TRUE(Settled());
  EXPECT_EQ(review.Path(), mission.Path());
  EXPECT_EQ(session.CurrentScan()->uuid, mission.First().uuid);
}

TEST_F(MissionSearchTest, WhatWasDecidedInAReviewLeadsToItsMission) {
  review.Open(mission.Path(), mission.First().uuid);
  ASSERT_TRUE(Settled());
  session.SelectObject(0);
  session.Decide(Decision::kRejected);
  ASSERT_TRUE(Settled());
  review.close();
  search.SetWhat(MissionSearchModel::What::kRejected);
  ASSERT_TRUE(Settled());
  ASSERT_EQ(search.Hits().size(), 1u);
  search.Open(0);
  ASSERT_TRUE(Settled());
  EXPECT_EQ(review.Path(), mission.Path());
  EXPECT_EQ(session.CurrentScan()->uuid, mission.First().uuid);
}

TEST_F(MissionSearchTest, AFolderThatIsNotThereIsSaid) {
  search.SetFolder(mission.Folder() + "/nowhere");
  ASSERT_TRUE(Settled());
  EXPECT_TRUE(search.Hits().empty());
  EXPECT_TRUE(search.Summary().contains(QStringLiteral("nowhere")));
}

TEST_F(MissionSearchTest, NothingFoundIsSaidToo) {
  Type(QStringLiteral("giraffe"));
  EXPECT_TRUE(search.Hits().empty());
  EXPECT_EQ(search.Summary().toStdString(), "0 found in 1 missions");
}

}  // namespace
}  // namespace foresight
