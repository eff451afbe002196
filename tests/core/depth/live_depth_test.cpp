#include "core/depth/live_depth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <span>

#include "core/depth/depth_method.h"
#include "tests/support/growing_scan.h"
#include "tests/support/sample_grids.h"

namespace foresight {
namespace {

const Scan& SmallScan() {
  // 80 lines about 2 px apart, with every other beam; made once, as it takes a while.
  static const Scan scan = [] {
    SensorRig rig = samples::RigWithImage(324, 242);
    rig.lidar.beams = 541;
    rig.lidar.angle_step_rad *= 2.0;
    return samples::SweepOverRoom(rig, RadiansFromDegrees(30.0));
  }();
  return scan;
}

DepthOptions FixedOptions(DepthMethod method) {
  return *FixedForPlan(DefaultsOf(method), SmallScan().plan, SmallScan().rig);
}

/// In bytes: NaN equals NaN, and 0 is not -0.
template <class T>
bool SameBits(std::span<const T> a, std::span<const T> b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

void ExpectSameBits(const DepthResult& live, const DepthResult& whole, const std::string& when) {
  SCOPED_TRACE(when);
  EXPECT_EQ(live.samples.samples.size(), whole.samples.samples.size());
  EXPECT_EQ(live.samples.reasons, whole.samples.reasons);
  EXPECT_TRUE(SameBits(live.dense.depth_m.values(), whole.dense.depth_m.values()));
  EXPECT_TRUE(SameBits(live.dense.confidence.values(), whole.dense.confidence.values()));
  ASSERT_EQ(live.dense.iterations.size(), whole.dense.iterations.size());
  for (std::size_t t = 0; t < live.dense.iterations.size(); ++t)
    EXPECT_TRUE(SameBits(live.dense.iterations[t].values(), whole.dense.iterations[t].values()));
  EXPECT_EQ(live.dense.mean_change_m, whole.dense.mean_change_m);
  EXPECT_EQ(live.dense.max_confidence, whole.dense.max_confidence);
  EXPECT_EQ(live.dense.nominal_confidence, whole.dense.nominal_confidence);
  EXPECT_EQ(live.dense.sigma_spatial_px, whole.dense.sigma_spatial_px);
  EXPECT_EQ(live.mask, whole.mask);
  EXPECT_EQ(live.density, whole.density);
}

/// Feeds the scan and compares each answer with that to all lines at once.
void ExpectTheSameAsTheWhole(const DepthOptions& options, int first_lines, int step,
                             int last_lines = 80) {
  const Scan& scan = SmallScan();
  LiveDepth live(scan.rig, scan.frames[0], options);
  for (int lines = first_lines; lines <= last_lines; lines += step) {
    const RegisteredScan registered = samples::RegisteredAfter(scan, lines);
    const auto grown = live.Update(registered, {});
    const auto whole = ComputeDepthInFrame(registered, scan.rig, scan.frames[0], options, {});
    ASSERT_TRUE(grown) << grown.error().message;
    ASSERT_TRUE(whole) << whole.error().message;
    ExpectSameBits(*grown, *whole, fmt::format("after {} lines", lines));
  }
}

TEST(LiveDepth, EqualsTheWholeComputationInEveryBitLineByLine) {
  ExpectTheSameAsTheWhole(FixedOptions(DepthMethod::kForesight), 38, 1, 44);
}

TEST(LiveDepth, EqualsTheWholeComputationInChunks) {
  ExpectTheSameAsTheWhole(FixedOptions(DepthMethod::kForesight), 8, 12);
}

TEST(LiveDepth, OfThePapersMethodEqualsTheWholeComputation) {
  ExpectTheSameAsTheWhole(FixedOptions(DepthMethod::kPaper), 30, 3);
}

TEST(LiveDepth, KeepsThePassesAndTheirChangesToo) {
  for (const DepthMethod method : {DepthMethod::kForesight, DepthMethod::kPaper}) {
    DepthOptions options = FixedOptions(method);
    options.local_plane.keep_iterations = options.upsample.keep_iterations = true;
    ExpectTheSameAsTheWhole(options, 40, 8, 56);
  }
}

TEST(LiveDepth, IsAsRightWhereTheLengthsFollowTheDensity) {
  ExpectTheSameAsTheWhole(DefaultsOf(DepthMethod::kForesight), 40, 10, 60);
  ExpectTheSameAsTheWhole(DefaultsOf(DepthMethod::kPaper), 40, 10);
}

TEST(LiveDepth, IsAsRightWithTheRejectionsThatMostLinesCanChange) {
  DepthOptions options = FixedOptions(DepthMethod::kForesight);
  options.flying = FlyingPointOptions::RangeAdaptive();  // a median over all samples
  options.isolated.enabled = true;
  options.flipping.test = FlippingPointOptions::Test::kMesh;
  ExpectTheSameAsTheWhole(options, 30, 5, 50);
}

TEST(LiveDepth, OfAMethodThatSolvesForTheWholeImageIsItsAnswer) {
  DepthOptions options = DefaultsOf(DepthMethod::kTgv);
  options.tgv.iterations = 20;  // not to wait for
  ExpectTheSameAsTheWhole(options, 50, 4, 54);
}

TEST(LiveDepth, FiltersOnlyTheBandThatFourLinesReach) {
  for (const DepthMethod method : {DepthMethod::kForesight, DepthMethod::kPaper}) {
    const Scan& scan = SmallScan();
    LiveDepth live(scan.rig, scan.frames[0], FixedOptions(method));
    ASSERT_TRUE(live.Update(samples::RegisteredAfter(scan, 40), {}));
    EXPECT_EQ(live.filtered_rows(), 242) << "the first time all rows";
    ASSERT_TRUE(live.Update(samples::RegisteredAfter(scan, 44), {}));
    EXPECT_GT(live.filtered_rows(), 0);
    EXPECT_LT(live.filtered_rows(), 242 / 2);
    ASSERT_TRUE(live.Update(samples::RegisteredAfter(scan, 44), {}));
    EXPECT_EQ(live.filtered_rows(), 0) << "nothing new";
  }
}

TEST(LiveDepth, IsRightAgainAfterItWasCancelled) {
  const Scan& scan = SmallScan();
  const DepthOptions options = FixedOptions(DepthMethod::kForesight);
  LiveDepth live(scan.rig, scan.frames[0], options);
  ASSERT_TRUE(live.Update(samples::RegisteredAfter(scan, 40), {}));
  std::stop_source stop;
  stop.request_stop();
  RunContext cancelled;
  cancelled.stop = stop.get_token();
  const RegisteredScan registered = samples::RegisteredAfter(scan, 48);
  EXPECT_EQ(live.Update(registered, cancelled).error().code, ErrorCode::kCancelled);
  const auto grown = live.Update(registered, {});
  const auto whole = ComputeDepthInFrame(registered, scan.rig, scan.frames[0], options, {});
  ASSERT_TRUE(grown && whole);
  ExpectSameBits(*grown, *whole, "after a cancelled update");
}

TEST(LiveDepth, StartsOverWithAnotherScanOfTheSameImage) {
  const Scan& scan = SmallScan();
  const DepthOptions options = FixedOptions(DepthMethod::kForesight);
  LiveDepth live(scan.rig, scan.frames[0], options);
  ASSERT_TRUE(live.Update(samples::RegisteredAfter(scan, 60), {}));
  const RegisteredScan shorter = samples::RegisteredAfter(scan, 40);
  const auto grown = live.Update(shorter, {});
  const auto whole = ComputeDepthInFrame(shorter, scan.rig, scan.frames[0], options, {});
  ASSERT_TRUE(grown && whole);
  ExpectSameBits(*grown, *whole, "with fewer lines");
}

TEST(LiveDepth, SaysThatNothingIsInTheImageYet) {
  Scan scan = SmallScan();
  // An image of what is above: the first lines look below it.
  scan.frames.Edit(0).motor_angle_rad = RadiansFromDegrees(40.0);
  LiveDepth live(scan.rig, scan.frames[0], FixedOptions(DepthMethod::kForesight));
  const auto depth = live.Update(samples::RegisteredAfter(scan, 2), {});
  ASSERT_FALSE(depth);
  EXPECT_EQ(depth.error().code, ErrorCode::kTooFewPoints);
}

TEST(LocalPlaneUpsampler, KnowsThatALineDecidesSlopesFartherAwayThanTheWindow) {
  // The window's radius is 26 px. Between the fourth and the fifth line are 52 px, as where a near
  // thing ends: the fifth reaches the fourth one's planes over the lidar's grid alone.
  AlignedSamples all = SamplesOnLattice(400, 200, 4, 12, [](int u, int v) {
    return v >= 120 ? NAN : 1.5 + 0.004 * v + 0.08 * std::sin(0.31 * u) * std::sin(0.9 * v + u);
  });
  for (AlignedSample& s : all.samples)
    if (s.line >= 4) s.v += 40.0f;
  const ColorImage guide(400, 200, {90, 90, 90});
  LocalPlaneOptions options;
  options.sigma_spatial_px = 13.0;
  options.along_line_px = 4.0;
  options.between_lines_px = 12.0;
  LocalPlaneUpsampler upsampler(guide, options);
  for (int lines = 2; lines <= 10; ++lines) {
    AlignedSamples samples = all;
    std::erase_if(samples.samples, [&](const AlignedSample& s) { return s.line >= lines; });
    samples.reasons.resize(samples.samples.size());
    ASSERT_TRUE(upsampler.Update(samples, {}));
    const auto whole = UpsampleLocalPlanes(samples, guide, options, {});
    ASSERT_TRUE(whole);
    EXPECT_TRUE(SameBits(upsampler.dense().depth_m.values(), whole->depth_m.values())) << lines;
    EXPECT_TRUE(SameBits(upsampler.dense().confidence.values(), whole->confidence.values()))
        << lines;
  }
}

TEST(FixedForPlan, TakesTheLengthsFromThePredictionAndKeepsGivenOnes) {
  const Scan& scan = SmallScan();
  DepthOptions options = DefaultsOf(DepthMethod::kForesight);
  options.upsample.sigma_spatial_px = 17.0;
  const auto fixed = FixedForPlan(options, scan.plan, scan.rig);
  ASSERT_TRUE(fixed);
  const auto predicted = PredictScan(scan.plan, scan.rig);
  EXPECT_EQ(fixed->upsample.sigma_spatial_px, 17.0);
  EXPECT_EQ(fixed->local_plane.sigma_spatial_px, LocalPlaneSigmaForDensity(predicted->density));
  EXPECT_EQ(fixed->local_plane.between_lines_px, std::max(1.0, predicted->line_spacing_px));
  EXPECT_EQ(fixed->isolated.along_line_px, std::max(1.0, predicted->beam_spacing_px));
  EXPECT_TRUE(fixed->Check());
}

TEST(FixedForPlan, RefusesAPlanThatCannotBeExecuted) {
  ScanPlan plan;
  plan.speed_rad_s = 0.0;
  const auto fixed = FixedForPlan({}, plan, DefaultSensorRig());
  ASSERT_FALSE(fixed);
  EXPECT_EQ(fixed.error().code, ErrorCode::kInvalidOptions);
}

}  // namespace
}  // namespace foresight
