#include "core/objects/valve_model.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/random.h"

namespace foresight {
namespace {

ValveModel DishedWheel(int spokes) {
  ValveModel model;
  model.rim_radius_m = 0.150;
  model.tube_radius_m = 0.012;
  model.spokes = spokes;
  model.dish_m = 0.040;
  return model;
}

Eigen::Vector3d PointNear(Random& random) {
  return {random.Uniform(-0.3, 0.3), random.Uniform(-0.3, 0.3), random.Uniform(-0.2, 0.2)};
}

TEST(ValveModel, MeasuresDistancesOfKnownPoints) {
  const ValveModel model = DishedWheel(4);
  const double kNothing_m = 1e-12;
  EXPECT_NEAR(model.Distance({0.150, 0.0, 0.050}), 0.038, kNothing_m);  // above the rim's tube
  EXPECT_NEAR(model.Distance({0.250, 0.0, 0.0}), 0.088, kNothing_m);    // outside the rim
  EXPECT_NEAR(model.Distance({0.0, 0.0, -0.100}), 0.040, kNothing_m);   // behind the hub
  EXPECT_NEAR(model.Distance({0.150, 0.0, 0.0}), -0.012, kNothing_m);   // inside the tube
}

ValveModel FlatWheel(int spokes) {
  ValveModel model = DishedWheel(spokes);
  model.rim_depth_ratio = 0.4;
  model.spoke_depth_ratio = 2.5;
  return model;
}

TEST(ValveModel, MeasuresDistancesToFlatAndUprightSections) {
  ValveModel model = FlatWheel(4);
  model.dish_m = 0.0;
  EXPECT_NEAR(model.Distance({0.150, 0.0, 0.050}), 0.030, 1e-9);     // above a spoke of 20 mm
  EXPECT_NEAR(model.Distance({0.106, 0.106, 0.050}), 0.0452, 1e-4);  // above the rim of 4.8 mm
  EXPECT_NEAR(model.Distance({0.0, 0.172, 0.0}), 0.010, 1e-9);       // outside the rim
  EXPECT_NEAR(model.Distance({0.080, 0.020, 0.0}), 0.012, 1e-9);     // beside a spoke
  // Off the section's axes: against the nearest of many points of the ellipse.
  const Eigen::Vector2d off(0.009, 0.007);
  double nearest = 1.0;
  for (int i = 0; i < 100000; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 100000;
    const Eigen::Vector2d on(0.012 * std::cos(angle), 0.0048 * std::sin(angle));
    nearest = std::min(nearest, (off - on).norm());
  }
  const double radial = (0.150 + off.x()) / std::numbers::sqrt2;  // between two spokes
  EXPECT_NEAR(model.Distance({radial, radial, off.y()}), nearest, 1e-6);
}

TEST(ValveModel, HasItsSpokesAtEqualAnglesFromX) {
  for (int spokes = 2; spokes <= 6; ++spokes) {
    const ValveModel model = DishedWheel(spokes);
    for (int i = 0; i < spokes; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / spokes;
      const Eigen::Vector3d middle(0.075 * std::cos(angle), 0.075 * std::sin(angle), -0.020);
      EXPECT_NEAR(model.Distance(middle), -model.spoke_radius_m, 1e-12) << spokes << " " << i;
    }
  }
}

TEST(ValveModel, IsTheSameAfterATurnByOneSpoke) {
  Random random(1);
  for (int spokes = 2; spokes <= 6; ++spokes) {
    const ValveModel model = DishedWheel(spokes);
    const Eigen::AngleAxisd turn(2.0 * std::numbers::pi / spokes, Eigen::Vector3d::UnitZ());
    for (int i = 0; i < 200; ++i) {
      const Eigen::Vector3d point = PointNear(random);
      EXPECT_NEAR(model.Distance(point), model.Distance(turn * point), 1e-12);
    }
  }
}

TEST(ValveModel, NeverChangesFasterThanThePointMoves) {
  // What sphere tracing relies on: a step as long as the distance can never jump over a surface.
  Random random(2);
  for (int spokes : {0, 2, 3, 4, 5, 6}) {
    const ValveModel model = DishedWheel(spokes);
    for (int i = 0; i < 2000; ++i) {
      const Eigen::Vector3d a = PointNear(random);
      const Eigen::Vector3d b = a + 0.02 * PointNear(random);
      EXPECT_LE(std::abs(model.Distance(a) - model.Distance(b)), (a - b).norm() + 1e-12);
    }
  }
}

TEST(ValveModel, DistanceGrowsAtUnitRateOutside) {
  Random random(3);
  const ValveModel model = DishedWheel(5);
  constexpr double kStep = 1e-6;
  int checked = 0;
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d point = PointNear(random);
    if (model.Distance(point) < 0.005) continue;
    Eigen::Vector3d gradient;
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(axis);
      gradient[axis] =
          (model.Distance(point + step) - model.Distance(point - step)) / (2.0 * kStep);
    }
    // Where two parts are equally near the gradient jumps; such points are rare.
    if (std::abs(gradient.norm() - 1.0) < 1e-4) ++checked;
  }
  EXPECT_GT(checked, 400);
}

TEST(ValveModel, ADiscIsClosedBetweenHubAndRim) {
  ValveModel disc = DishedWheel(0);
  EXPECT_NEAR(disc.Distance({0.06, 0.045, -0.020}), -disc.spoke_radius_m, 1e-12);
}

TEST(ValveModel, RefusesWhatIsNoWheel) {
  ValveModel model;
  EXPECT_TRUE(model.Check());
  model.spokes = 1;
  EXPECT_FALSE(model.Check());
  model = ValveModel();
  model.tube_radius_m = 2.0 * model.rim_radius_m;
  EXPECT_FALSE(model.Check());
  model = ValveModel();
  model.rim_radius_m = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(model.Check());
}

TEST(ValveWireframe, RunsWithinTheTemplate) {
  const ValveModel model = DishedWheel(3);
  const Wireframe lines = WireframeOf(model);
  ASSERT_GE(lines.size(), 3U);
  for (const Eigen::Vector3d& point : lines.front())
    EXPECT_NEAR(model.Distance(point), 0.0, 1e-9);  // the rim's outer edge lies on the surface
}

}  // namespace
}  // namespace foresight
