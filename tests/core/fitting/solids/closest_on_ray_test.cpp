#include "core/fitting/solids/closest_on_ray.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/objects/solid_distance.h"

namespace foresight {
namespace {

Eigen::Vector3d Within(double size, Random& random) {
  return {random.Uniform(-size, size), random.Uniform(-size, size), random.Uniform(-size, size)};
}

/// From 1.5 m past a solid of some 10 cm; every fourth along one or two of its axes.
RayBesideSolid RandomRay(int i, Random& random) {
  RayBesideSolid ray;
  ray.origin = 1.5 * Within(1.0, random).normalized();
  ray.direction = Within(0.2, random) - ray.origin;
  if (i % 4 == 1) ray.direction[i / 4 % 3] = 0.0;
  if (i % 4 == 2) {
    ray.direction = Eigen::Vector3d::Unit(i / 4 % 3);
    ray.origin = Within(0.2, random) - 1.5 * ray.direction;
  }
  ray.direction.normalize();
  return ray;
}

/// The least distance by small steps, then smaller ones.
double BySteps(SolidPart::Shape shape, const RayBesideSolid& ray, const Eigen::Vector3d& half) {
  double best_m = 1e9, middle = 1.5, width = 1.5;
  for (const double step : {2e-3, 2e-5, 2e-7}) {
    double at = middle;
    for (double range = middle - width; range < middle + width; range += step) {
      const double distance = DistanceToSolid(shape, ray.origin + range * ray.direction, half);
      if (distance < best_m) best_m = distance, at = range;
    }
    middle = at;
    width = 2.0 * step;
  }
  return best_m;
}

void CheckAgainstSteps(SolidPart::Shape shape) {
  Random random(11);
  int checked = 0;
  for (int i = 0; i < 600; ++i) {
    const Eigen::Vector3d half(random.Uniform(0.005, 0.06), random.Uniform(0.005, 0.06),
                               random.Uniform(0.005, 0.12));
    const RayBesideSolid ray = RandomRay(i, random);
    const double truth_m = BySteps(shape, ray, half);
    if (truth_m < 1e-6) continue;  // it enters the solid
    ++checked;
    const ClosestApproach closest = ClosestBeside(shape, ray, half);
    EXPECT_NEAR(closest.distance_m, truth_m, 1e-7) << i;
    EXPECT_EQ(closest.distance_m,
              DistanceToSolid(shape, ray.origin + closest.range_m * ray.direction, half))
        << i;
  }
  EXPECT_GT(checked, 300);
}

TEST(ClosestOnRay, OfABoxIsWhatSmallStepsFind) {
  CheckAgainstSteps(SolidPart::Shape::kBox);
}

TEST(ClosestOnRay, OfACylinderIsWhatSmallStepsFind) {
  CheckAgainstSteps(SolidPart::Shape::kCylinder);
}

TEST(ClosestOnRay, OfACapsuleIsWhatSmallStepsFind) {
  CheckAgainstSteps(SolidPart::Shape::kCapsule);
}

TEST(ClosestOnRay, DeepestInsideIsNoLessDeepThanTheMiddleOfWhatIsPassed) {
  Random random(12);
  for (const SolidPart::Shape shape :
       {SolidPart::Shape::kBox, SolidPart::Shape::kCylinder, SolidPart::Shape::kCapsule}) {
    const Eigen::Vector3d half(0.03, 0.03, 0.08);
    for (int i = 0; i < 100; ++i) {
      RayBesideSolid ray;
      ray.origin = 1.5 * Within(1.0, random).normalized();
      ray.direction = (Within(0.01, random) - ray.origin).normalized();
      const double deepest_m = DeepestInside(shape, ray, half);
      EXPECT_LT(deepest_m, -0.015) << i;
      EXPECT_NEAR(deepest_m, BySteps(shape, ray, half), 1e-6) << i;
    }
  }
}

TEST(ClosestOnRay, DeepestInsideIsWhatSmallStepsFindWhereverTheLineEnters) {
  Random random(14);
  for (const SolidPart::Shape shape : {SolidPart::Shape::kBox, SolidPart::Shape::kCylinder}) {
    int checked = 0;
    for (int i = 0; i < 1500; ++i) {
      const Eigen::Vector3d half(random.Uniform(0.02, 0.12), random.Uniform(0.02, 0.12),
                                 random.Uniform(0.01, 0.12));
      const RayBesideSolid ray = RandomRay(i, random);
      const double truth_m = BySteps(shape, ray, half);
      if (truth_m > -1e-6) continue;  // it misses the solid
      ++checked;
      EXPECT_NEAR(DeepestInside(shape, ray, half), truth_m, 1e-6) << i;
    }
    EXPECT_GT(checked, 150);
  }
}

}  // namespace
}  // namespace foresight
