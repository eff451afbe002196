#include "core/detection/residuals.h"

#include <gtest/gtest.h>

namespace foresight {
namespace {

/// A wheel that faces the viewpoint at the origin from 2 m, and one ray to the top of its rim.
ValveDetection Wheel() {
  ValveDetection valve;
  valve.best.base_from_object = {Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0), {0.0, 0.0, 2.0}};
  return valve;
}

RaySet RayTo(const Eigen::Vector3d& point) {
  RaySet set;
  set.rays = {{Eigen::Vector3d::Zero(), point.normalized(), point.norm(), {0, 0}}};
  return set;
}

TEST(Residuals, APointInFrontOfTheRimIsAheadOfIt) {
  const ValveDetection valve = Wheel();
  const Eigen::Vector3d rim(0.0, -valve.best.model.rim_radius_m,
                            2.0 - valve.best.model.tube_radius_m);
  const auto exact = ResidualsOf(valve, 0, RayTo(rim));
  ASSERT_EQ(exact.size(), 1U);
  EXPECT_NEAR(exact[0].ahead_m, 0.0, 0.001);  // the tracer stops half a millimetre before it
  const auto nearer = ResidualsOf(valve, 0, RayTo(0.99 * rim));
  ASSERT_EQ(nearer.size(), 1U);
  EXPECT_NEAR(nearer[0].ahead_m, 0.01 * rim.norm(), 0.001);
}

TEST(Residuals, ABeamThroughTheWheelOrFarFromItSaysNothing) {
  const ValveDetection valve = Wheel();
  EXPECT_TRUE(ResidualsOf(valve, 0, RayTo({0.5, 0.0, 2.0})).empty());
  EXPECT_TRUE(ResidualsOf(valve, 0, RayTo({0.0, -0.1, 2.4})).empty());
}

TEST(Residuals, OfTerrainAreThoseToTheNearestSurface) {
  TerrainDetection terrain;
  terrain.surfaces.resize(2);
  for (TerrainSurface& surface : terrain.surfaces) surface.size_m = {1.0, 1.0};
  terrain.surfaces[0].base_from_object = {Eigen::Quaterniond::Identity(), {0.0, 0.0, 2.00}};
  terrain.surfaces[1].base_from_object = {Eigen::Quaterniond::Identity(), {0.0, 0.0, 2.05}};
  const auto residuals = ResidualsOf(terrain, 0, RayTo({0.0, 0.0, 2.04}));
  ASSERT_EQ(residuals.size(), 1U);
  EXPECT_NEAR(residuals[0].ahead_m, 0.01, 1e-9);
  EXPECT_TRUE(ResidualsOf(terrain, 0, RayTo({2.0, 0.0, 2.0})).empty());
}

}  // namespace
}  // namespace foresight
