#include "core/fitting/handle/door_columns.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/fitting/handle/door_things.h"
#include "tests/support/on_every_vector_target.h"

namespace foresight {
namespace {

Eigen::Vector3d Somewhere(double size, Random& random) {
  return {random.Uniform(-size, size), random.Uniform(-size, size), random.Uniform(-size, size)};
}

/// A bent bar, a ball, a round plate and a turned one.
DoorThing SomeThing(Random& random) {
  const Eigen::Vector3d knee = Somewhere(0.03, random), ball = Somewhere(0.1, random);
  const double radius_m = random.Uniform(0.005, 0.02);
  DoorThing::Plate round, strip;
  round.front_m = -0.04;
  round.at = {random.Uniform(-0.05, 0.05), 0.0};
  round.radius_m = 0.025;
  strip.front_m = -0.05;
  strip.turn_rad = random.Uniform(-1.0, 1.0);
  strip.half_m = {0.02, 0.08};
  return DoorThing({{Somewhere(0.1, random), knee, radius_m},
                    {knee, Somewhere(0.1, random), radius_m},
                    {ball, ball, 0.02}},
                   {round, strip},
                   {Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(),
                                                       Eigen::Vector3d(-1.0, 0.2, 0.1)),
                    {1.0, 0.1, -0.1}});
}

class DoorColumnsTest : public OnEveryVectorTarget {};

TEST_P(DoorColumnsTest, SeeWhatOneRayAfterAnotherSees) {
  Random random(21);
  int hits = 0, passes = 0, misses = 0;
  for (int thing_count = 0; thing_count < 60; ++thing_count) {
    const DoorThing thing = SomeThing(random);
    const double reach_m = random.Uniform(0.0, 0.02);
    std::vector<RangeRay> rays;
    RayColumns columns;
    for (int i = 0; i < 101; ++i) {
      RangeRay ray;
      ray.origin = Somewhere(0.1, random);
      ray.direction =
          (Eigen::Vector3d(1.0, 0.1, -0.1) + Somewhere(0.15, random) - ray.origin).normalized();
      rays.push_back(ray);
      columns.Add(ray.origin.data(), ray.direction.data(), reach_m);
    }
    columns.Pad();
    std::vector<double> clearance_m(columns.Padded()), range_m(columns.Padded());
    IntersectColumns(thing.Placed(), columns, clearance_m, range_m);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const auto alone = thing.Intersect(rays[i], reach_m);
      ++(!alone ? misses : alone->clearance_m < 0.0 ? hits : passes);
      if (!alone) {
        EXPECT_TRUE(std::isinf(clearance_m[i])) << i;
        continue;
      }
      EXPECT_NEAR(clearance_m[i], alone->clearance_m, 1e-10) << i;
      EXPECT_NEAR(range_m[i], alone->range_m, 1e-7) << i;
    }
  }
  EXPECT_GT(hits, 500);
  EXPECT_GT(passes, 200);
  EXPECT_GT(misses, 500);
}

INSTANTIATE_TEST_SUITE_P(Targets, DoorColumnsTest, testing::ValuesIn(VectorTargets()),
                         VectorTargetName);

}  // namespace
}  // namespace foresight
