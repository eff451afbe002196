// Quantiles of errors that were measured with noise.
#include "core/selfcheck/error_spread.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"

namespace foresight {
namespace {

TEST(QuantileWithoutNoise, TakesTheNoiseOut) {
  Random random(3);
  std::vector<NoisyError> errors;
  for (int i = 0; i < 20000; ++i)
    errors.push_back({0.004 * random.Normal() + 0.006 * random.Normal(), 0.006 * random.Normal()});
  // Quantiles of |z|: 0.674 and 1.282. 5000 values tell the sum's deviation to 1 %, and the
  // error's, which is the lesser part of it, to 3 %; the ladder of widths blurs a little more.
  EXPECT_NEAR(QuantileWithoutNoise(errors, 0.5), 0.674 * 0.004, 0.15 * 0.674 * 0.004);
  EXPECT_NEAR(QuantileWithoutNoise(errors, 0.8), 1.282 * 0.004, 0.12 * 1.282 * 0.004);
}

TEST(QuantileWithoutNoise, KeepsAHeavyTail) {
  Random random(4);
  std::vector<NoisyError> errors;
  for (int i = 0; i < 4000; ++i)
    errors.push_back({(i % 10 == 0 ? 0.5 : 0.005) * random.Normal(), 0.002 * random.Normal()});
  // Half of the tenth that is wide lies beyond 0.674 * 0.5 m; its 400 values scatter by 5 %.
  EXPECT_NEAR(QuantileWithoutNoise(errors, 0.95), 0.337, 0.05);
  EXPECT_LT(QuantileWithoutNoise(errors, 0.8), 0.012);
}

TEST(QuantileWithoutNoise, IsNothingWhereTheNoiseExplainsAll) {
  const std::vector<NoisyError> errors(100, {0.001, 0.010});
  EXPECT_EQ(QuantileWithoutNoise(errors, 0.8), 0.0);
}

TEST(QuantileWithoutNoise, OfNothingIsNotKnown) {
  EXPECT_TRUE(std::isnan(QuantileWithoutNoise({}, 0.8)));
  const std::vector<NoisyError> none = {{std::nan(""), 0.01}};
  EXPECT_TRUE(std::isnan(QuantileWithoutNoise(none, 0.8)));
}

}  // namespace
}  // namespace foresight
