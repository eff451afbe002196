#include "core/sensor/polynomial.h"

#include <gtest/gtest.h>

#include "core/sensor/growing_function.h"

namespace foresight {
namespace {

TEST(SignChanges, AreTheSimpleRoots) {
  // (x - 1) (x - 2) (x - 4) = -8 + 14 x - 7 x^2 + x^3.
  const std::vector<double> cubic = {-8.0, 14.0, -7.0, 1.0};
  const std::vector<double> changes = SignChanges(cubic, 10.0);
  ASSERT_EQ(changes.size(), 3u);
  EXPECT_NEAR(changes[0], 1.0, 1e-14);
  EXPECT_NEAR(changes[1], 2.0, 1e-14);
  EXPECT_NEAR(changes[2], 4.0, 1e-14);
  EXPECT_EQ(SignChanges(cubic, 3.0).size(), 2u);
}

TEST(SignChanges, AreNoneWhereAPolynomialStaysAboveZero) {
  EXPECT_TRUE(SignChanges(std::vector<double>{1.0001, -2.0, 1.0}, 10.0).empty());  // (x - 1)^2 + ..
  EXPECT_TRUE(SignChanges(std::vector<double>{1.0, 2.0}, 10.0).empty());
}

TEST(SignChanges, StandOnTheSideBeforeTheChange) {
  const std::vector<double> falling = {1.0, 0.0, -0.9};
  const std::vector<double> changes = SignChanges(falling, 1e6);
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_GT(PolynomialAt(falling, changes[0]), 0.0);
}

TEST(SolveGrowing, FindsTheArgumentWhereNewtonAloneWouldJumpAway) {
  // arctan from far out: Newton's step overshoots farther each time.
  const auto arctan = [](double x) { return std::pair(std::atan(x), 1.0 / (1.0 + x * x)); };
  EXPECT_NEAR(SolveGrowing(arctan, 0.1, -1e3, 1e3, 900.0), std::tan(0.1), 1e-15);
}

TEST(SolveGrowing, FindsTheEndWhereTheFunctionStopsGrowing) {
  const auto folds = [](double x) { return std::pair(x - 0.1 * x * x * x, 1.0 - 0.3 * x * x); };
  const double end = std::sqrt(1.0 / 0.3);
  EXPECT_NEAR(SolveGrowing(folds, 2.0 / 3.0 * end, 0.0, end, 1.0), end, 1e-7);
}

}  // namespace
}  // namespace foresight
