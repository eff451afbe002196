#include <gtest/gtest.h>

#include "tests/ui/synthetic_scan.h"
#include "tests/ui/wait_for.h"
#include "ui/viewmodels/compare_view_model.h"

namespace foresight {
namespace {

using Kind = CompareViewModel::Kind;

std::shared_ptr<const Scan> ThinScan() {
  static const auto scan = std::make_shared<const Scan>(
      WallAndValveScan({.from_rad = -0.1, .to_rad = 0.1, .speed_rad_s = 0.2}));
  return scan;
}

struct DepthChoice : testing::Test {
  SessionModel session{SessionMode::kSimulation};
  DepthViewModel depth{&session};
  CompareViewModel compare{&session, &depth};

  void SetUp() override {
    depth.setMethod(DepthMethod::kPaper);  // whichever is the default
    session.SetScan(ThinScan());
    ASSERT_TRUE(Idle());
    ASSERT_NE(session.Depth(), nullptr);
  }
  bool Idle() {
    return WaitFor([&] { return !depth.Runner()->Busy() && !compare.Runner()->Busy(); });
  }
};

TEST_F(DepthChoice, TheOldDepthStaysMarkedUntilTheNewMethodHasItsOwn) {
  const auto old = session.Depth();
  depth.setMethod(DepthMethod::kJointBilateral);
  EXPECT_TRUE(depth.Recomputing());
  EXPECT_EQ(session.Depth(), old);
  EXPECT_EQ(depth.ShownOptions().method, DepthMethod::kPaper);
  ASSERT_TRUE(Idle());
  EXPECT_FALSE(depth.Recomputing());
  EXPECT_NE(session.Depth(), old);
  EXPECT_EQ(depth.ShownOptions().method, DepthMethod::kJointBilateral);
  EXPECT_EQ(session.Depth()->samples.KeptCount(), session.Depth()->samples.samples.size());
}

TEST_F(DepthChoice, CancellingReturnsToTheMethodOnTheScreen) {
  const auto old = session.Depth();
  depth.setThreshold(0.5);
  depth.setMethod(DepthMethod::kJointBilateral);
  depth.Runner()->cancel();
  ASSERT_TRUE(Idle());
  EXPECT_EQ(session.Depth(), old);
  EXPECT_EQ(depth.Method(), DepthMethod::kPaper);
  EXPECT_EQ(depth.Threshold(), 0.5);
}

TEST_F(DepthChoice, EveryMethodKeepsTheThresholdThatWasLastUsedWithIt) {
  depth.setThreshold(0.5);
  depth.setMethod(DepthMethod::kJointBilateral);
  EXPECT_EQ(depth.Threshold(), DefaultsOf(DepthMethod::kJointBilateral).mask.threshold);
  depth.setMethod(DepthMethod::kPaper);
  EXPECT_EQ(depth.Threshold(), 0.5);
  EXPECT_TRUE(Idle());
}

TEST_F(DepthChoice, PassesAreKeptOnlyOnceTheyAreAskedFor) {
  EXPECT_TRUE(session.Depth()->dense.iterations.empty());
  depth.setKeepIterations(true);
  ASSERT_TRUE(Idle());
  const DenseDepth& dense = session.Depth()->dense;
  EXPECT_EQ(dense.iterations.size(), dense.mean_change_m.size() + 1);
  EXPECT_EQ(depth.ComputedCount(), 2);
}

TEST_F(DepthChoice, ForesightsOwnMethodHasPassesToStepThroughToo) {
  depth.setMethod(DepthMethod::kForesight);
  ASSERT_TRUE(Idle());
  EXPECT_TRUE(session.Depth()->dense.iterations.empty());
  depth.setKeepIterations(true);
  ASSERT_TRUE(Idle());
  const DenseDepth& dense = session.Depth()->dense;
  EXPECT_EQ(dense.iterations.size(), depth.Options().local_plane.iterations + 1u);
  EXPECT_EQ(dense.mean_change_m.size() + 1, dense.iterations.size());
}

TEST_F(DepthChoice, PassesAskedForWhileAMethodIsComputedComeWithIt) {
  depth.setMethod(DepthMethod::kForesight);
  depth.setKeepIterations(true);
  ASSERT_TRUE(Idle());
  EXPECT_EQ(depth.ShownOptions().method, DepthMethod::kForesight);
  EXPECT_FALSE(session.Depth()->dense.iterations.empty());
}

TEST_F(DepthChoice, AMethodWithoutPassesIsNotComputedAgainForThem) {
  depth.setMethod(DepthMethod::kJointBilateral);
  ASSERT_TRUE(Idle());
  const auto first = session.Depth();
  depth.setKeepIterations(true);
  ASSERT_TRUE(Idle());
  EXPECT_EQ(session.Depth(), first);
}

TEST_F(DepthChoice, AnotherMethodIsPutBesideTheDepthWithoutTouchingIt) {
  const auto first = session.Depth();
  compare.compareWithMethod(DepthMethod::kJointBilateral);
  ASSERT_TRUE(Idle());
  ASSERT_NE(compare.Second(), nullptr);
  EXPECT_EQ(session.Depth(), first);
  EXPECT_FALSE(compare.Second()->dense.depth_m == first->dense.depth_m);
}

TEST_F(DepthChoice, AFrozenDepthKeepsItsMaskWhileTheThresholdMoves) {
  compare.compareWithFrozen();
  const auto frozen = compare.SecondMask();
  depth.setThreshold(0.9);
  EXPECT_EQ(compare.SecondMask(), frozen);
  EXPECT_NE(session.Mask(), frozen);
  EXPECT_TRUE(compare.SecondTitle().contains("0.35")) << compare.SecondTitle().toStdString();
}

TEST_F(DepthChoice, ANewScanDropsTheFrozenDepthAndComputesTheOtherMethodAgain) {
  compare.compareWithFrozen();
  session.SetScan(std::make_shared<const Scan>(*ThinScan()));
  EXPECT_EQ(compare.With(), Kind::kNothing);
  compare.compareWithMethod(DepthMethod::kJointBilateral);
  EXPECT_EQ(compare.Second(), nullptr) << "the first depth comes first";
  ASSERT_TRUE(WaitFor([&] { return compare.Second() != nullptr; }));
}

TEST_F(DepthChoice, TheLineStaysWithinTheImage) {
  compare.setWipe(1.7);
  EXPECT_EQ(compare.Wipe(), 1.0);
  compare.setWipe(-0.2);
  EXPECT_EQ(compare.Wipe(), 0.0);
}

}  // namespace
}  // namespace foresight
