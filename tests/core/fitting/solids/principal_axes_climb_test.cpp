#include "core/fitting/solids/principal_axes_climb.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <limits>

namespace foresight {
namespace {

constexpr int kParameters = 5;

/// A hill that is a million times sharper across its ridge than along it, and its ridge crosses all
/// parameters.
struct Hill {
  Hill() {
    Eigen::MatrixXd mixed(kParameters, kParameters);
    for (int row = 0; row < kParameters; ++row)
      for (int column = 0; column < kParameters; ++column)
        mixed(row, column) = std::sin(1.0 + 3.0 * row + 7.0 * column * column);
    const Eigen::MatrixXd axes = Eigen::HouseholderQR<Eigen::MatrixXd>(mixed).householderQ();
    Eigen::VectorXd bends(kParameters);
    bends << 1e6, 1e4, 1e4, 100.0, 1.0;
    information = axes * bends.asDiagonal() * axes.transpose();
    top = axes.col(4) * 1.5 + axes.col(0) * 0.01;  // 1.5 deviations along, 10 across
  }

  double operator()(const Eigen::VectorXd& at) const {
    return -0.5 * (at - top).dot(information * (at - top));
  }
  ScoreShape ShapeAt(const Eigen::VectorXd& at) const {
    return {information * (top - at), information};
  }

  Eigen::MatrixXd information;
  Eigen::VectorXd top;
};

PatternSearchResult StartOf(const Hill& hill) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(kParameters);
  return {zero, hill(zero)};
}

TEST(PrincipalAxesClimb, ReachesTheTopOfARidgeThatSingleStepsDoNot) {
  const Hill hill;
  PatternSearchOptions single;
  for (int i = 0; i < kParameters; ++i)
    single.steps.push_back(0.1 * Eigen::VectorXd::Unit(kParameters, i));
  const PatternSearchResult rough = ClimbByPatternSearch(StartOf(hill).values, hill, single);
  ASSERT_LT(rough.score, -0.5);
  const PatternSearchResult found = ClimbAlongPrincipalAxes(
      rough, hill, [&](const Eigen::VectorXd& at) { return hill.ShapeAt(at); });
  EXPECT_LT((found.values - hill.top).norm(), 1e-6);
  EXPECT_EQ(found.score, hill(found.values));
}

TEST(PrincipalAxesClimb, ClimbsWhereTheSlopeKnowsNothing) {
  const Hill hill;
  const auto flat = [&](const Eigen::VectorXd&) -> ScoreShape {
    return {Eigen::VectorXd::Zero(kParameters), hill.information};
  };
  const PatternSearchResult found = ClimbAlongPrincipalAxes(StartOf(hill), hill, flat);
  EXPECT_GT(found.score, -0.01);
}

TEST(PrincipalAxesClimb, AStepThatOvershootsIsShortened) {
  const Hill hill;
  // A slope of four times what it is: the whole step and a half of it lead down.
  const auto steep = [&](const Eigen::VectorXd& at) -> ScoreShape {
    return {4.0 * (hill.information * (hill.top - at)), hill.information};
  };
  const PatternSearchResult found = ClimbAlongPrincipalAxes(StartOf(hill), hill, steep);
  EXPECT_LT((found.values - hill.top).norm(), 1e-6);
}

TEST(PrincipalAxesClimb, AShapeThatIsNoNumberMovesNothing) {
  const Hill hill;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto no_number = [&](const Eigen::VectorXd&) -> ScoreShape {
    return {Eigen::VectorXd::Constant(kParameters, nan),
            Eigen::MatrixXd::Constant(kParameters, kParameters, nan)};
  };
  const PatternSearchResult start = StartOf(hill);
  const PatternSearchResult found = ClimbAlongPrincipalAxes(start, hill, no_number);
  EXPECT_EQ(found.values, start.values);
  EXPECT_EQ(found.score, start.score);
}

}  // namespace
}  // namespace foresight
