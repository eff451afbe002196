#include "core/objects/handle_model.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace foresight {
namespace {

TEST(HandleModel, ABowedLeverLiesBesideItsLineAsAParabola) {
  HandleModel model;
  model.length_m = 0.120;
  model.bow_m = 0.012;
  model.lift_m = -0.008;
  const std::vector<Eigen::Vector3d> path = LeverPathOf(model);
  EXPECT_EQ(path.front(), Eigen::Vector3d::Zero());
  EXPECT_TRUE(path.back().isApprox(Eigen::Vector3d(0.120, 0.0, 0.0)));
  // On the surface beside the middle line, and off the door.
  const double r = model.radius_m;
  EXPECT_NEAR(model.Distance({0.060, 0.012 + r, -0.008}), 0.0, 1e-3);
  EXPECT_NEAR(model.Distance({0.060, 0.012, -0.008 + r}), 0.0, 1e-3);
  EXPECT_NEAR(model.Distance({0.030, 0.75 * 0.012 + r, -0.75 * 0.008}), 0.0, 1e-3);
  // Where a straight one would be.
  model.bow_m = model.lift_m = 0.0;
  EXPECT_NEAR(model.Distance({0.060, r, 0.0}), 0.0, 1e-9);
  EXPECT_EQ(LeverPathOf(model).size(), 2u);
}

TEST(HandleModel, TheOutlineOfABowedLeverIsDrawnAlongIt) {
  HandleModel model;
  model.behind_m = 0.020;
  model.bow_m = 0.015;
  const auto& outline = WireframeOf(model).front();
  const auto beside = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return a.y() < b.y();
  };
  EXPECT_NEAR(std::max_element(outline.begin(), outline.end(), beside)->y(),
              model.bow_m + model.radius_m, 1e-3);
  EXPECT_NEAR(std::min_element(outline.begin(), outline.end(), beside)->y(), -model.radius_m, 1e-3);
  const auto along = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return a.x() < b.x();
  };
  EXPECT_NEAR(std::min_element(outline.begin(), outline.end(), along)->x(),
              -model.behind_m - model.radius_m, 1e-3);
  EXPECT_EQ(outline.front(), outline.back());
}

TEST(HandleModel, ALeverThatIsBowedByMoreThanHalfItsLengthIsRefused) {
  HandleModel model;
  model.bow_m = 0.05;
  model.lift_m = 0.05;
  ASSERT_FALSE(model.Check());
  EXPECT_NE(model.Check().error().message.find("bow_m 0.05"), std::string::npos);
  model.lift_m = 0.0;
  EXPECT_TRUE(model.Check());
}

}  // namespace
}  // namespace foresight
