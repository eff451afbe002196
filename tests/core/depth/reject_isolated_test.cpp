#include "core/depth/reject_isolated.h"

#include <gtest/gtest.h>

#include "tests/support/sample_grids.h"

namespace foresight {
namespace {

IsolatedPointOptions LatticeSpacing() {
  IsolatedPointOptions options;
  options.along_line_px = 4;
  options.between_lines_px = 12;
  return options;
}

TEST(IsolatedPoints, RemovesASampleAllByItself) {
  AlignedSamples samples = SamplesOnLattice(
      200, 120, 4, 12, [](int u, int v) { return u < 80 || (u == 160 && v == 60) ? 1.0 : NAN; });
  ASSERT_TRUE(RejectIsolated(samples, LatticeSpacing()));
  EXPECT_EQ(ReasonAt(samples, 5, 40), RejectReason::kIsolated);
  EXPECT_EQ(ReasonAt(samples, 5, 10), RejectReason::kKept);
}

TEST(IsolatedPoints, KeepsABlockOfTwoByTwo) {
  AlignedSamples samples = SamplesOnLattice(200, 120, 4, 12, [](int u, int v) {
    return (u == 100 || u == 104) && (v == 48 || v == 60) ? 1.0 : NAN;
  });
  ASSERT_TRUE(RejectIsolated(samples, LatticeSpacing()));
  EXPECT_EQ(samples.KeptCount(), 4u);
}

TEST(IsolatedPoints, RemovesASingleRow) {
  AlignedSamples samples =
      SamplesOnLattice(200, 120, 4, 12, [](int, int v) { return v == 60 ? 1.0 : NAN; });
  ASSERT_TRUE(RejectIsolated(samples, LatticeSpacing()));
  EXPECT_EQ(samples.KeptCount(), 0u);
}

TEST(IsolatedPoints, MeasuresTheSpacingItself) {
  AlignedSamples samples = SamplesOnLattice(200, 120, 5, 9, [](int, int) { return 1.0; });
  const auto spacing = MeasureSpacing(samples);
  ASSERT_TRUE(spacing);
  EXPECT_DOUBLE_EQ(spacing->along_line_px, 5.0);
  EXPECT_DOUBLE_EQ(spacing->between_lines_px, 9.0);
  ASSERT_TRUE(RejectIsolated(samples, {}));
  EXPECT_EQ(samples.KeptCount(), samples.samples.size());
}

TEST(LocalDensity, IsThatOfTheScannedPartOfTheImage) {
  const auto left_half = [](int u, int) { return u < 100 ? 1.0 : NAN; };
  const AlignedSamples samples = SamplesOnLattice(200, 120, 4, 12, left_half);
  EXPECT_NEAR(samples.Density(), 0.5 / 48.0, 0.001);
  EXPECT_NEAR(LocalDensity(samples), 1.0 / 48.0, 1e-9);
}

TEST(IsolatedPoints, DoesNotTouchWhatIsAlreadyRejected) {
  AlignedSamples samples = SamplesOnLattice(200, 120, 4, 12, [](int, int) { return 1.0; });
  samples.reasons[7] = RejectReason::kFlying;
  ASSERT_TRUE(RejectIsolated(samples, LatticeSpacing()));
  EXPECT_EQ(samples.reasons[7], RejectReason::kFlying);
}

}  // namespace
}  // namespace foresight
