#include "core/depth/reject_flying.h"

#include <gtest/gtest.h>

#include "tests/support/sample_grids.h"

namespace foresight {
namespace {

/// One surface at 1 m to the left of column 80, another at 2 m behind, and one sample at 1.5 m
/// between.
AlignedSamples StepWithAFloatingPoint() {
  return SamplesOnLattice(160, 24, 4, 12, [](int u, int) {
    return u < 80 ? 1.0 : u == 80 ? 1.5 : 2.0;
  });
}

TEST(FlyingPoints, RemovesAPointFloatingBetweenTwoSurfaces) {
  AlignedSamples samples = StepWithAFloatingPoint();
  FlyingPointOptions options;
  options.rule = FlyingPointOptions::Rule::kBothNeighboursFar;
  ASSERT_TRUE(RejectFlying(samples, options));
  EXPECT_EQ(ReasonAt(samples, 0, 20), RejectReason::kFlying);
  EXPECT_EQ(ReasonAt(samples, 0, 19), RejectReason::kKept);
  EXPECT_EQ(ReasonAt(samples, 0, 21), RejectReason::kKept);
}

TEST(FlyingPoints, AsPrintedAlsoRemovesTheEdgesBesideIt) {
  AlignedSamples samples = StepWithAFloatingPoint();
  ASSERT_TRUE(RejectFlying(samples, {}));
  for (const int beam : {19, 20, 21}) EXPECT_EQ(ReasonAt(samples, 0, beam), RejectReason::kFlying);
  EXPECT_EQ(ReasonAt(samples, 0, 18), RejectReason::kKept);
}

TEST(FlyingPoints, AsPrintedRemovesAFlatWallWhoseBeamsAreFurtherApartThanTheThreshold) {
  // 4 px at f = 500 are 32 mm at 4 m: a known limit of Eq. (7), pinned down here.
  AlignedSamples samples = SamplesOnLattice(160, 24, 4, 12, [](int, int) { return 4.0; });
  ASSERT_TRUE(RejectFlying(samples, {}));
  EXPECT_EQ(samples.KeptCount(), 0u);
}

TEST(FlyingPoints, ByDepthKeepsThatWall) {
  AlignedSamples samples = SamplesOnLattice(160, 24, 4, 12, [](int, int) { return 4.0; });
  FlyingPointOptions options;
  options.distance = FlyingPointOptions::Distance::kDepth;
  ASSERT_TRUE(RejectFlying(samples, options));
  EXPECT_EQ(samples.KeptCount(), samples.samples.size());
}

TEST(FlyingPoints, ANeighbourWithoutAMeasurementDoesNotVote) {
  AlignedSamples samples =
      SamplesOnLattice(160, 24, 4, 12, [](int u, int) { return u == 40 ? NAN : 1.0; });
  ASSERT_TRUE(RejectFlying(samples, {}));
  EXPECT_EQ(samples.KeptCount(), samples.samples.size());
}

TEST(FlyingPoints, LinesDoNotInfluenceEachOther) {
  AlignedSamples samples =
      SamplesOnLattice(160, 36, 4, 12, [](int, int v) { return v == 12 ? 2.0 : 1.0; });
  ASSERT_TRUE(RejectFlying(samples, {}));
  EXPECT_EQ(samples.KeptCount(), samples.samples.size());
}

TEST(FlyingPoints, TheThresholdMayGrowWithRange) {
  AlignedSamples samples = SamplesOnLattice(160, 24, 4, 12, [](int, int) { return 4.0; });
  FlyingPointOptions options;
  options.threshold_per_metre = 0.01;
  ASSERT_TRUE(RejectFlying(samples, options));
  EXPECT_EQ(samples.KeptCount(), samples.samples.size());
}

TEST(FlyingPoints, AsPrintedIsTheDefault) {
  const FlyingPointOptions options;
  EXPECT_EQ(options.rule, FlyingPointOptions::Rule::kAnyNeighbourFar);
  EXPECT_EQ(options.distance, FlyingPointOptions::Distance::kEuclidean);
  EXPECT_EQ(options.threshold_m, 0.030);
  EXPECT_EQ(options.threshold_per_metre, 0.0);
  EXPECT_EQ(options.threshold_per_step, 0.0);
}

TEST(FlyingPoints, RangeAdaptiveKeepsASlantedWallAtAnyRange) {
  for (const double range_m : {1.0, 4.0, 9.0, 25.0}) {
    SCOPED_TRACE(range_m);
    // z = range + 1.5 x. From beam to beam that is up to 1.97 z du / f, on the far side.
    AlignedSamples samples = SamplesOnLattice(
        160, 24, 4, 12, [&](int u, int) { return range_m / (1.0 - 1.5 * (u - 80) / 500.0); });
    ASSERT_TRUE(RejectFlying(samples, FlyingPointOptions::RangeAdaptive()));
    EXPECT_EQ(samples.KeptCount(), samples.samples.size());
  }
}

TEST(FlyingPoints, RangeAdaptiveRemovesAPointFloatingFarAway) {
  // 2 z du / f + 30 mm is 0.19 m at 10 m.
  AlignedSamples samples = SamplesOnLattice(160, 24, 4, 12, [](int u, int) {
    return u < 80 ? 10.0 : u == 80 ? 10.5 : 11.0;
  });
  ASSERT_TRUE(RejectFlying(samples, FlyingPointOptions::RangeAdaptive()));
  EXPECT_EQ(ReasonAt(samples, 0, 20), RejectReason::kFlying);
  EXPECT_EQ(ReasonAt(samples, 0, 18), RejectReason::kKept);
  EXPECT_EQ(ReasonAt(samples, 0, 22), RejectReason::kKept);
}

TEST(FlyingPoints, WithoutPointsRangeAdaptiveIsThirtyMillimetresOfDepth) {
  for (const double step_m : {0.029, 0.031}) {
    AlignedSamples samples =
        SamplesOnLattice(160, 24, 4, 12, [&](int u, int) { return u < 80 ? 8.0 : 8.0 + step_m; });
    for (AlignedSample& s : samples.samples) s.point = {0.0f, 0.0f, s.depth_m};
    ASSERT_TRUE(RejectFlying(samples, FlyingPointOptions::RangeAdaptive()));
    EXPECT_EQ(ReasonAt(samples, 0, 20) == RejectReason::kFlying, step_m > 0.030);
  }
}

TEST(FlyingPoints, OffRemovesNothing) {
  AlignedSamples samples = StepWithAFloatingPoint();
  FlyingPointOptions options;
  options.rule = FlyingPointOptions::Rule::kOff;
  ASSERT_TRUE(RejectFlying(samples, options));
  EXPECT_EQ(samples.KeptCount(), samples.samples.size());
}

TEST(FlyingPoints, RefusesAThresholdThatIsNone) {
  AlignedSamples samples = StepWithAFloatingPoint();
  FlyingPointOptions options;
  options.threshold_m = 0.0;
  EXPECT_NE(RejectFlying(samples, options).error().message.find("threshold_m"), std::string::npos);
}

}  // namespace
}  // namespace foresight
