#include "core/evaluation/depth_accuracy.h"

#include <gtest/gtest.h>

#include <cmath>

namespace foresight {
namespace {

TEST(Percentile, IsTheValueAtItsRank) {
  std::vector<double> values;
  for (int i = 100; i >= 1; --i) values.push_back(i);
  EXPECT_EQ(Percentile(values, 80.0), 80.0);
  EXPECT_EQ(Percentile(values, 95.0), 95.0);
  std::vector<double> none;
  EXPECT_TRUE(std::isnan(Percentile(none, 80.0)));
}

TEST(ScoreDepth, ScoresOnlyWhatIsKeptAndKnown) {
  DepthImage depth(4, 1, 1.0f), truth(4, 1, 1.0f);
  MaskImage mask(4, 1, 255);
  depth(0, 0) = 1.010f;
  mask(1, 0) = 0;     // known, not kept
  truth(2, 0) = NAN;  // kept, not known: invented
  depth(3, 0) = NAN;  // known, "kept" without a depth
  const auto accuracy = ScoreDepth(depth, mask, truth, 1);
  ASSERT_TRUE(accuracy);
  EXPECT_NEAR(accuracy->a95_mm, 10.0, 1e-3);
  EXPECT_EQ(accuracy->scored, 1);
  EXPECT_NEAR(accuracy->coverage, 1.0 / 3.0, 1e-12);
  EXPECT_EQ(accuracy->unscored_kept, 1.0);
}

TEST(ScoreDepth, RefusesImagesOfDifferentSize) {
  EXPECT_FALSE(ScoreDepth(DepthImage(4, 1), MaskImage(4, 1), DepthImage(3, 1), 1));
}

}  // namespace
}  // namespace foresight
