#include "core/depth/reject_flipping.h"

#include <gtest/gtest.h>

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
  options.cells_from_kept_only = false;
  ASSERT_TRUE(RejectFlipping(from_all, options, {}));
  EXPECT_EQ(ReasonAt(from_all, 2, 30), RejectReason::kFlipping);
}

}  // namespace
}  // namespace foresight
