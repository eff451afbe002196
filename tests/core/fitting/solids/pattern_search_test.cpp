#include "core/fitting/solids/pattern_search.h"

#include <gtest/gtest.h>

namespace foresight {
namespace {

PatternSearchOptions UnitSteps(int rounds) {
  PatternSearchOptions options;
  options.rounds = rounds;
  for (int i = 0; i < 2; ++i) options.steps.push_back(Eigen::VectorXd::Unit(2, i));
  return options;
}

TEST(PatternSearch, FindsTheTopOfAHill) {
  const Eigen::Vector2d top(1.3, -2.1);
  const auto hill = [&](const Eigen::VectorXd& at) { return -(at - top).squaredNorm(); };
  const PatternSearchResult found =
      ClimbByPatternSearch(Eigen::VectorXd::Zero(2), hill, UnitSteps(8));
  EXPECT_LT((found.values - top).norm(), 0.02);  // the last steps are 1/128
  EXPECT_EQ(found.score, hill(found.values));
}

TEST(PatternSearch, FollowsARidgeAcrossItsSteps) {
  // Both values must change together: single steps alone would end 0.8 from the top.
  const auto ridge = [](const Eigen::VectorXd& at) {
    const double across = at[0] - at[1], along = at[0] + at[1] - 5.0;
    return -10.0 * across * across - along * along;
  };
  const PatternSearchResult found =
      ClimbByPatternSearch(Eigen::VectorXd::Zero(2), ridge, UnitSteps(6));
  EXPECT_LT((found.values - Eigen::Vector2d(2.5, 2.5)).norm(), 0.1);
}

TEST(PatternSearch, StepsToTheTopOfAParabolaWhereBothWaysLeadDown) {
  const Eigen::Vector2d top(0.3, -0.2);
  int tries = 0;
  const auto hill = [&](const Eigen::VectorXd& at) {
    ++tries;
    return -(at - top).squaredNorm();
  };
  PatternSearchOptions options = UnitSteps(1);
  options.passes = 1;
  const PatternSearchResult found = ClimbByPatternSearch(Eigen::VectorXd::Zero(2), hill, options);
  EXPECT_LT((found.values - top).norm(), 1e-9);
  EXPECT_LE(tries, 8);  // the start, three along each direction, and once more the same way
}

TEST(PatternSearch, ADirectionWhoseTopIsReachedRests) {
  int tries = 0;
  const auto top = [&](const Eigen::VectorXd& at) {
    ++tries;
    return -at.squaredNorm();
  };
  ClimbByPatternSearch(Eigen::VectorXd::Zero(2), top, UnitSteps(4));
  EXPECT_LE(tries, 9);  // the start, and two along each direction of the first and third round
}

TEST(PatternSearch, StaysWhereEverythingElseIsWorse) {
  const Eigen::Vector2d start(0.3, 0.4);
  const auto spike = [&](const Eigen::VectorXd& at) { return at == start ? 1.0 : 0.0; };
  const PatternSearchResult found = ClimbByPatternSearch(start, spike, UnitSteps(4));
  EXPECT_EQ(found.values, start);
  EXPECT_EQ(found.score, 1.0);
}

}  // namespace
}  // namespace foresight
