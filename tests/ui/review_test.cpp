#include "ui/viewmodels/review_view_model.h"

#include <gtest/gtest.h>

#include <QTemporaryDir>

#include "tests/ui/synthetic_scan.h"
#include "tests/ui/wait_for.h"
#include "ui/viewmodels/mission_objects.h"
#include "ui/viewmodels/review_check_flow.h"

namespace foresight {
namespace {

struct ReviewTest : testing::Test {
  QTemporaryDir folder;
  QString path = folder.filePath("m.foresight");
  Scan scan = WallAndValveScan({.from_rad = -0.02, .to_rad = 0.02, .speed_rad_s = 0.1});
  TaskQueue tasks;
  SessionModel session{SessionMode::kReplay, &tasks};
  ReviewViewModel review{&session};
  std::vector<Notice> notices;

  ReviewTest() {
    QObject::connect(&session, &SessionModel::noticed,
                     [this](const Notice& notice) { notices.push_back(notice); });
    const auto file = MissionFile::Create(path.toStdString());
    EXPECT_TRUE(file);
    EXPECT_TRUE(AppendScan(file->get(), scan, {}));
    EXPECT_TRUE(KeepObject(file->get(), Valve(), "operator"));
    EXPECT_TRUE((*file)->Close());
  }
  FoundObject Valve() const {
    ValveDetection detection;
    detection.best.model.rim_radius_m = 0.123;
    detection.origin.roi = ImageRoi::Rectangle(0.0, {10, 10}, {50, 50});
    FoundObject valve;
    valve.detection = detection;
    valve.rig = scan.rig;
    valve.scan_uuid = scan.uuid;
    return valve;
  }
  bool Settled() {
    return WaitFor([&] { return !review.Busy(); });
  }
};

TEST_F(ReviewTest, AMissionOpensWithItsScanAndItsObjects) {
  int opened = 0;
  QObject::connect(&review, &ReviewViewModel::opened, [&] { ++opened; });
  review.Open(path);
  ASSERT_TRUE(Settled());
  EXPECT_EQ(opened, 1);
  ASSERT_NE(session.CurrentScan(), nullptr);
  EXPECT_EQ(session.CurrentScan()->uuid, scan.uuid);
  ASSERT_EQ(session.Objects().size(), 1u);
  EXPECT_EQ(std::get<ValveDetection>(session.Objects()[0].detection).best.model.rim_radius_m,
            0.123);
  EXPECT_TRUE(session.IsCurrent(session.Objects()[0]));
  EXPECT_TRUE(session.Objects()[0].kept);
}

TEST_F(ReviewTest, WhatIsFoundInReviewIsKeptBesideTheMissionWhichStaysAsItIs) {
  review.Open(path);
  ASSERT_TRUE(Settled());
  session.AddObject(Valve());
  session.Decide(Decision::kRejected);
  ASSERT_TRUE(Settled());
  EXPECT_TRUE(session.Objects()[1].kept);
  EXPECT_EQ((*MissionFile::OpenReadOnly(path.toStdString()))->ListDetections()->size(), 1u);
  review.close();
  review.Open(path);
  ASSERT_TRUE(Settled());
  ASSERT_EQ(session.Objects().size(), 2u);
  EXPECT_EQ(session.Objects()[1].decision, Decision::kRejected);
  EXPECT_TRUE(notices.empty());
}

TEST_F(ReviewTest, ADecisionOnAnObjectOfTheMissionIsKeptInTheReview) {
  review.Open(path);
  ASSERT_TRUE(Settled());
  session.Decide(Decision::kAccepted);
  ASSERT_TRUE(Settled());
  EXPECT_EQ((*MissionFile::OpenReadOnly(path.toStdString()))->ListDetections()->at(0).decision,
            Decision::kOpen);
  review.close();
  review.Open(path);
  ASSERT_TRUE(Settled());
  ASSERT_EQ(session.Objects().size(), 1u);
  EXPECT_EQ(session.Objects()[0].decision, Decision::kAccepted);
}

TEST_F(ReviewTest, AFileThatIsNoMissionIsReportedAndChangesNothing) {
  review.Open(path);
  ASSERT_TRUE(Settled());
  review.Open(folder.filePath("missing.foresight"));
  ASSERT_TRUE(Settled());
  ASSERT_EQ(notices.size(), 1u);
  EXPECT_EQ(notices[0].level, Notice::Level::kError);
  EXPECT_EQ(review.Path(), path);
}

TEST_F(ReviewTest, ACheckThatWasNeverKeptIsLookedForOnce) {
  ScanCheckModel check(&session);
  ReviewCheckFlow flow(&review, &session, &check);
  review.Open(path);
  ASSERT_TRUE(WaitFor([&] { return !review.Busy() && tasks.Idle(); }));
  EXPECT_EQ(flow.ReadCount(), 1);
  EXPECT_EQ(check.Now(), ScanCheckModel::State::kNotChecked);
  session.AddObject(Valve());  // keeping it changes the review, before and after
  ASSERT_TRUE(WaitFor([&] { return !review.Busy() && tasks.Idle(); }));
  EXPECT_EQ(flow.ReadCount(), 1);
  review.Open(path);  // asked for anew it is looked for anew: somebody may have checked meanwhile
  ASSERT_TRUE(WaitFor([&] { return !review.Busy() && tasks.Idle(); }));
  EXPECT_EQ(flow.ReadCount(), 2);
}

struct ReviewOfCheckedScansTest : ReviewTest {
  /// A scan whose edges say, each alone too weakly, that the camera turned by so much about y.
  static KeptCheck WeakCheck(const Scan& scan, double turn_rad) {
    ScanCheck check;
    check.light = CheckLight::kGood;
    check.advice = "nothing to do";
    CameraCheck& camera = check.rig.camera.emplace();
    camera.turn_rad = {0.0, turn_rad, 0.0};
    camera.covariance = 3e-6 * Eigen::Matrix3d::Identity();
    camera.score = 0.5;
    camera.score_before = 0.4;
    camera.gain_sigmas = 5.0;
    camera.edges = 400;
    return NewKeptCheck(scan, check, {});
  }

  /// To the mission: that of its scan, and weak ones of others.
  Status AddChecks(const KeptCheck& of_scan, std::initializer_list<const char*> others,
                   double turn_rad) const {
    FORESIGHT_TRY(const auto file, MissionFile::Open(path.toStdString()));
    FORESIGHT_CHECK(AddScanCheck(*file, of_scan));
    for (const char* uuid : others) {
      Scan other = scan;
      other.uuid = uuid;
      FORESIGHT_CHECK(AddScanCheck(*file, WeakCheck(other, turn_rad)));
    }
    return file->Close();
  }
};

TEST_F(ReviewOfCheckedScansTest, GoodScansDoNotMakeTheLampOfOneThatShowsNothingGreen) {
  ScanCheck nothing;
  nothing.advice = "nothing can be said";
  ASSERT_TRUE(AddChecks(NewKeptCheck(scan, nothing, {}), {"b", "c", "d"}, 0.0));
  ScanCheckModel check(&session);
  ReviewCheckFlow flow(&review, &session, &check);
  review.Open(path);
  ASSERT_TRUE(WaitFor([&] { return !review.Busy() && tasks.Idle(); }));
  ASSERT_NE(check.Together(), nullptr);
  EXPECT_EQ(check.Together()->check.light, CheckLight::kGood);
  EXPECT_EQ(check.Light(), CheckLight::kNotSeen);
  EXPECT_EQ(check.Sentence(), "Nothing can be said");
}

TEST_F(ReviewOfCheckedScansTest, ScansOfAMissionSayTogetherWhatOneDoesNot) {
  ASSERT_TRUE(AddChecks(WeakCheck(scan, 0.0052), {"b", "c", "d", "e"}, 0.0052));
  ScanCheckModel check(&session);
  ReviewCheckFlow flow(&review, &session, &check);
  review.Open(path);
  ASSERT_TRUE(WaitFor([&] { return !review.Busy() && tasks.Idle(); }));
  ASSERT_NE(check.Check(), nullptr);
  EXPECT_EQ(check.Check()->light, CheckLight::kGood) << "the scan alone";
  ASSERT_NE(check.Together(), nullptr);
  EXPECT_EQ(check.Light(), CheckLight::kAmber);
  EXPECT_TRUE(check.Sentence().startsWith("5 scans together: image edges lie"))
      << check.Sentence().toStdString();
  check.BeginMission();
  EXPECT_EQ(check.Together(), nullptr);
  EXPECT_EQ(check.Light(), CheckLight::kGood);
}

}  // namespace
}  // namespace foresight
