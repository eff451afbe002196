#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/ui/synthetic_scan.h"
#include "tests/ui/wait_for.h"
#include "ui/viewmodels/depth_view_model.h"
#include "ui/viewmodels/fit_view_model.h"

namespace foresight {
namespace {

using testing::Contains;
using testing::HasSubstr;

/// The wall with the valve as the head's floor: the head looks down.
std::shared_ptr<const Scan> FloorScan() {
  static const auto scan = [] {
    Scan floor = WallAndValveScan({.from_rad = -0.1, .to_rad = 0.1, .speed_rad_s = 0.1});
    floor.rig.robot_from_base = {
        Eigen::Quaterniond::FromTwoVectors(-Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitZ()),
        {0.0, 0.0, 2.0}};
    return std::make_shared<const Scan>(std::move(floor));
  }();
  return scan;
}

/// A scan whose depth has just begun to be computed when the operator draws a region.
struct WaitingFit : testing::Test {
  WaitingFit() {
    QObject::connect(&session, &SessionModel::noticed, &session, [this](const Notice& notice) {
      notices.push_back(notice.what.toStdString());
    });
    depth.setMethod(DepthMethod::kJointBilateral);
    session.SetScan(FloorScan());
  }
  void DrawTerrain() {
    fit.SetTool(ObjectKind::kTerrain, true);
    fit.DrawRegion({{220, 190}, {430, 290}});
  }
  /// Neither the depth nor the fit, nor what they began, goes on.
  bool Idle() {
    return WaitFor(
        [&] { return !depth.Runner()->Busy() && !fit.Waiting() && !fit.Runner()->Busy(); });
  }

  SessionModel session{SessionMode::kSimulation};
  DepthViewModel depth{&session};
  FitViewModel fit{&session};
  std::vector<std::string> notices;
};

TEST_F(WaitingFit, ATerrainWaitsForItsDepthMapAndIsFittedToIt) {
  ASSERT_TRUE(session.DepthComing());
  DrawTerrain();
  EXPECT_TRUE(fit.Waiting());
  EXPECT_EQ(fit.From(), FitSource::kDepth);
  EXPECT_THAT(notices, Contains(HasSubstr("waits for the depth map")));
  ASSERT_TRUE(Idle());
  ASSERT_NE(session.Depth(), nullptr);
  ASSERT_EQ(session.Objects().size(), 1u) << testing::PrintToString(notices);
  EXPECT_EQ(OriginOf(session.Objects()[0].detection).source, "jbu");
}

TEST_F(WaitingFit, WhereTheMapIsCancelledTheTerrainIsFittedToLidarPoints) {
  ASSERT_TRUE(WaitFor([&] { return session.Cloud() != nullptr; }));
  DrawTerrain();
  ASSERT_TRUE(fit.Waiting());
  depth.cancel();
  ASSERT_TRUE(Idle());
  EXPECT_EQ(session.Depth(), nullptr);
  ASSERT_EQ(session.Objects().size(), 1u);
  EXPECT_EQ(OriginOf(session.Objects()[0].detection).source, "raw");
}

TEST_F(WaitingFit, WhoChoosesLidarPointsWaitsForNoMap) {
  ASSERT_TRUE(WaitFor([&] { return session.Cloud() != nullptr; }));
  fit.SetSource(FitSource::kRaw);
  DrawTerrain();
  EXPECT_FALSE(fit.Waiting());
  ASSERT_TRUE(Idle());
  EXPECT_EQ(session.Objects().size(), 1u);
}

TEST_F(WaitingFit, ItWaitsOnWhenLateLinesOfItsScanCome) {
  DrawTerrain();
  ASSERT_TRUE(fit.Waiting());
  session.SetScan(std::make_shared<const Scan>(*FloorScan()));
  EXPECT_TRUE(fit.Waiting());
  ASSERT_TRUE(Idle());
  ASSERT_EQ(session.Objects().size(), 1u) << testing::PrintToString(notices);
  EXPECT_EQ(OriginOf(session.Objects()[0].detection).source, "jbu");
}

TEST_F(WaitingFit, AnotherScanEndsTheWaitAndThatIsSaid) {
  DrawTerrain();
  ASSERT_TRUE(fit.Waiting());
  session.ExpectScan();
  ASSERT_TRUE(Idle());
  EXPECT_TRUE(session.Objects().empty());
  EXPECT_THAT(notices, Contains(HasSubstr("another scan came before the depth map")));
}

TEST_F(WaitingFit, NoRegionEndsTheWait) {
  DrawTerrain();
  ASSERT_TRUE(fit.Waiting());
  session.SetRoi(std::nullopt);
  ASSERT_TRUE(Idle());
  EXPECT_TRUE(session.Objects().empty());
}

}  // namespace
}  // namespace foresight
