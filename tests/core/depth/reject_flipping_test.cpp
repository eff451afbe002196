#include "core/depth/reject_flipping.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/depth/reject_flying.h"
#include "tests/support/sample_grids.h"

namespace foresight {
namespace {

/// A wall at 2 m whose samples were moved by parallax behind a plate at 1 m: the wall's sample of
/// line 2, beam 30 appears in the middle of the plate.
AlignedSamples WallSampleInFrontPlate(double invader_depth_m) {
  AlignedSamples samples =
      SamplesOnLattice(200, 96, 4, 12, [](int u, int) { return u < 100 ? 1.0 : 2.0; });
  for (auto& sample : samples.samples)
    if (sample.line == 2 && sample.beam == 30) {
      sample.u = 50.0f;
      sample.depth_m = static_cast<float>(invader_depth_m);
    }
  return samples;
}

TEST(FlippingPoints, RejectsAFarSampleInsideANearCell) {
  AlignedSamples samples = WallSampleInFrontPlate(2.0);
  ASSERT_TRUE(RejectFlipping(samples, {}, {}));
  EXPECT_EQ(ReasonAt(samples, 2, 30), RejectReason::kFlipping);
}

TEST(FlippingPoints, RejectsNothingElse) {
  AlignedSamples samples = WallSampleInFrontPlate(2.0);
  ASSERT_TRUE(RejectFlipping(samples, {}, {}));
  EXPECT_EQ(samples.KeptCount(), samples.samples.size() - 1);
}

TEST(FlippingPoints, KeepsANearSampleInsideAFarCell) {
  AlignedSamples samples = WallSampleInFrontPlate(0.9);
  ASSERT_TRUE(RejectFlipping(samples, {}, {}));
  EXPECT_EQ(ReasonAt(samples, 2, 30), RejectReason::kKept);
}

TEST(FlippingPoints, TheMarginSparesNoiseOnOneSurface) {
  AlignedSamples samples = WallSampleInFrontPlate(1.03);
  FlippingPointOptions options;
  options.margin_m = 0.05;
  ASSERT_TRUE(RejectFlipping(samples, options, {}));
  EXPECT_EQ(ReasonAt(samples, 2, 30), RejectReason::kKept);
  // As printed, without a margin, the same sample goes.
  ASSERT_TRUE(RejectFlipping(samples, {}, {}));
  EXPECT_EQ(ReasonAt(samples, 2, 30), RejectReason::kFlipping);
}

TEST(FlippingPoints, ASampleOnACellsEdgeIsInsideIt) {
  // The invader's row, 24, is a row of the plate's own corners: an exclusive test would reject
  // nothing on rectified images.
  AlignedSamples samples = WallSampleInFrontPlate(2.0);
  ASSERT_TRUE(RejectFlipping(samples, {}, {}));
  EXPECT_EQ(ReasonAt(samples, 2, 30), RejectReason::kFlipping);
}

TEST(FlippingPoints, CellsNeedAllFourCornersKept) {
  AlignedSamples samples = WallSampleInFrontPlate(2.0);
  for (std::size_t i = 0; i < samples.samples.size(); ++i)
    if (samples.samples[i].u < 100.0f && samples.samples[i].beam % 2 == 0 &&
        samples.samples[i].beam != 30)
      samples.reasons[i] = RejectReason::kFlying;
  AlignedSamples from_all = samples;
  ASSERT_TRUE(RejectFlipping(samples, {}, {}));
  EXPECT_EQ(ReasonAt(samples, 2, 30), RejectReason::kKept);
  FlippingPointOptions options;
  options.cells = FlippingPointOptions::Cells::kFromAllSamples;
  ASSERT_TRUE(RejectFlipping(from_all, options, {}));
  EXPECT_EQ(ReasonAt(from_all, 2, 30), RejectReason::kFlipping);
}

TEST(FlippingPoints, AppliedAfterTheCellsEquationSevenDoesNotBreakThem) {
  // Noise of the plate exceeds T_f from beam to beam: Eq. (7) rejects it, the wall's sample behind
  // it stays.
  AlignedSamples samples = SamplesOnLattice(200, 96, 4, 12, [](int u, int) {
    return u >= 100 ? 2.0 : u % 8 == 0 ? 0.98 : 1.02;
  });
  for (auto& sample : samples.samples)
    if (sample.line == 2 && sample.beam == 30) sample.u = 50.0f;
  FlyingPointOptions flying;
  flying.distance = FlyingPointOptions::Distance::kDepth;
  ASSERT_TRUE(RejectFlying(samples, flying));
  ASSERT_EQ(ReasonAt(samples, 2, 12), RejectReason::kFlying);
  ASSERT_EQ(ReasonAt(samples, 2, 30), RejectReason::kKept);
  AlignedSamples cells_first = samples;
  ASSERT_TRUE(RejectFlipping(samples, {}, {}));
  EXPECT_EQ(ReasonAt(samples, 2, 30), RejectReason::kKept);
  FlippingPointOptions options;
  options.cells = FlippingPointOptions::Cells::kFromAllSamples;
  ASSERT_TRUE(RejectFlipping(cells_first, options, {}));
  EXPECT_EQ(ReasonAt(cells_first, 2, 30), RejectReason::kFlipping);
  EXPECT_EQ(ReasonAt(cells_first, 2, 12), RejectReason::kFlying);
}

FlippingPointOptions Mesh(double margin_m) {
  FlippingPointOptions options;
  options.test = FlippingPointOptions::Test::kMesh;
  options.margin_m = margin_m;
  return options;
}

/// A slanted, noisy plate before a slanted, noisy wall as a lidar 60 px of parallax to the left
/// sees them: wall samples that the plate hides from the camera are mixed in with its own.
struct HiddenWall {
  AlignedSamples samples;
  std::vector<bool> hidden;
};

HiddenWall PlateBeforeAWall(int plate_left, int plate_right) {
  constexpr double kParallaxPx = 60.0;  // of something at 1 m
  Random random(11);
  const auto plate_m = [](double u) { return 1.0 + 0.0005 * u; };
  const auto wall_m = [](double u) { return 2.0 + 0.001 * u; };
  HiddenWall scene;
  // In the lidar's image first.
  scene.samples = SamplesOnLattice(400, 120, 4, 12, [&](int u, int) {
    return (u >= plate_left && u < plate_right ? plate_m(u) : wall_m(u)) + 0.01 * random.Normal();
  });
  std::vector<AlignedSample> seen;
  for (AlignedSample& s : scene.samples.samples) {
    const bool of_plate = s.depth_m < 1.6f;
    s.u += static_cast<float>(kParallaxPx * (1.0 - 1.0 / s.depth_m) - 15.0);
    if (s.u < 0.0f) continue;
    seen.push_back(s);
    const double edge = kParallaxPx * (1.0 - 1.0 / plate_m(plate_left)) - 15.0;
    const double end = kParallaxPx * (1.0 - 1.0 / plate_m(plate_right - 4)) - 15.0;
    scene.hidden.push_back(!of_plate && s.u > static_cast<float>(plate_left + edge) + 1.0f &&
                           s.u < static_cast<float>(plate_right - 4 + end) - 1.0f);
  }
  scene.samples.samples = seen;
  scene.samples.reasons.assign(seen.size(), RejectReason::kKept);
  return scene;
}

struct Score {
  double precision, recall;
  int hidden;
};

Score ScoreOf(const HiddenWall& scene, const FlippingPointOptions& options) {
  AlignedSamples samples = scene.samples;
  EXPECT_TRUE(RejectFlipping(samples, options, {}));
  int hits = 0, rejected = 0, hidden = 0;
  for (std::size_t i = 0; i < samples.samples.size(); ++i) {
    const bool out = samples.reasons[i] == RejectReason::kFlipping;
    rejected += out ? 1 : 0;
    hidden += scene.hidden[i] ? 1 : 0;
    hits += out && scene.hidden[i] ? 1 : 0;
  }
  return {rejected > 0 ? static_cast<double>(hits) / rejected : 0.0,
          hidden > 0 ? static_cast<double>(hits) / hidden : 0.0, hidden};
}

TEST(FlippingPoints, TheMeshFindsTheHiddenSamplesAndNoOthers) {
  const HiddenWall scene = PlateBeforeAWall(120, 280);
  const Score score = ScoreOf(scene, Mesh(0.05));
  ASSERT_GT(score.hidden, 50);
  // Less than 1: noise moves the plate's edge by half a pixel, and what it covers is not in
  // `hidden`.
  EXPECT_GE(score.precision, 0.9);
  EXPECT_GE(score.recall, 0.9);
}

TEST(FlippingPoints, TheMeshHasNoCellOnAnObjectOneSampleWide) {
  // A known limit: cells across the depth step catch what the mesh cannot.
  const HiddenWall scene = PlateBeforeAWall(200, 204);
  AlignedSamples by_mesh = scene.samples;
  ASSERT_TRUE(RejectFlipping(by_mesh, Mesh(0.05), {}));
  EXPECT_EQ(by_mesh.KeptCount(), by_mesh.samples.size());
}

TEST(FlippingPoints, CellsAcrossDepthStepsStillSeeAThinObject) {
  AlignedSamples samples =
      SamplesOnLattice(200, 96, 4, 12, [](int u, int) { return u == 48 ? 1.0 : 2.0; });
  for (auto& sample : samples.samples)
    if (sample.line == 2 && sample.beam == 30) {
      sample.u = 49.0f;
      sample.depth_m = 2.1f;
    }
  AlignedSamples by_mesh = samples;
  FlippingPointOptions cells;
  cells.margin_m = 0.05;
  ASSERT_TRUE(RejectFlipping(samples, cells, {}));
  EXPECT_EQ(ReasonAt(samples, 2, 30), RejectReason::kFlipping);
  ASSERT_TRUE(RejectFlipping(by_mesh, Mesh(0.05), {}));
  EXPECT_EQ(ReasonAt(by_mesh, 2, 30), RejectReason::kKept);
}

TEST(FlippingPoints, TheMeshIsAPlaneInSpaceBetweenItsCorners) {
  // One cell from 1 m to 2 m, 8 px wide: halfway a plane is at 4/3 m, not at 1.5 m.
  for (const auto& [depth_m, expected] :
       {std::pair{1.32f, RejectReason::kKept}, {1.35f, RejectReason::kFlipping}}) {
    AlignedSamples samples =
        SamplesOnLattice(16, 16, 8, 8, [](int u, int) { return u == 0 ? 1.0 : 2.0; });
    samples.lines = 3;
    samples.samples.push_back({4.0f, 4.0f, depth_m, 2, 0, {0.0f, 0.0f, depth_m}});
    samples.reasons.push_back(RejectReason::kKept);
    FlippingPointOptions options = Mesh(0.0);
    options.connected_step_m = 1.1;
    ASSERT_TRUE(RejectFlipping(samples, options, {}));
    EXPECT_EQ(ReasonAt(samples, 2, 0), expected) << depth_m;
  }
}

TEST(FlippingPoints, TheMeshDoesNotRejectItsOwnCorners) {
  Random random(5);
  AlignedSamples samples = SamplesOnLattice(
      200, 96, 4, 12, [&](int u, int) { return 1.0 + 0.003 * u + 0.005 * random.Normal(); });
  ASSERT_TRUE(RejectFlipping(samples, Mesh(0.0), {}));
  EXPECT_EQ(samples.KeptCount(), samples.samples.size());
}

TEST(FlippingPoints, DoNotDependOnTheNumberOfThreads) {
  for (const FlippingPointOptions& options : {FlippingPointOptions(), Mesh(0.05)}) {
    AlignedSamples one = PlateBeforeAWall(120, 280).samples;
    AlignedSamples four = one;
    RunContext context;
    context.threads = 1;
    ASSERT_TRUE(RejectFlipping(one, options, context));
    context.threads = 4;
    ASSERT_TRUE(RejectFlipping(four, options, context));
    EXPECT_EQ(one.reasons, four.reasons);
  }
}

TEST(FlippingPoints, RefusesAMarginOrStepThatIsNone) {
  AlignedSamples samples = WallSampleInFrontPlate(2.0);
  EXPECT_NE(RejectFlipping(samples, Mesh(-0.1), {}).error().message.find("margin_m"),
            std::string::npos);
  FlippingPointOptions options = Mesh(0.0);
  options.connected_step_m = 0.0;
  EXPECT_NE(RejectFlipping(samples, options, {}).error().message.find("connected_step_m"),
            std::string::npos);
}

}  // namespace
}  // namespace foresight
