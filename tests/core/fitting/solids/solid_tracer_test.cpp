#include "core/fitting/solids/solid_tracer.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/base/random.h"
#include "core/objects/drill_template.h"

namespace foresight {
namespace {

constexpr double kReach_m = 0.03;
constexpr double kStep_m = 0.0005;

/// A ray from 1.5 m that passes the origin's neighbourhood.
RangeRay RandomRay(Random& random) {
  const auto within = [&](double size) {
    return Eigen::Vector3d(random.Uniform(-size, size), random.Uniform(-size, size),
                           random.Uniform(-size, size));
  };
  RangeRay ray;
  ray.origin = 1.5 * within(1.0).normalized();
  ray.direction = (Eigen::Vector3d(0.0, 0.0, 0.12) + within(0.25) - ray.origin).normalized();
  return ray;
}

struct Walk {
  double clearance_m = std::numeric_limits<double>::infinity();
  double enters_m = std::numeric_limits<double>::infinity();
};

/// The same by small steps along the ray.
Walk WalkAlong(const RangeRay& ray, const DrillModel& model) {
  Walk walk;
  for (double range = 0.8; range < 2.4; range += kStep_m) {
    const double distance = model.Distance(ray.origin + range * ray.direction);
    walk.clearance_m = std::min(walk.clearance_m, distance);
    if (distance < 0.0) walk.enters_m = std::min(walk.enters_m, range);
  }
  return walk;
}

TEST(SolidTracer, IntersectsWhatSmallStepsAlongTheRayIntersect) {
  Random random(5);
  int hits = 0, passes = 0, misses = 0;
  for (const DrillTemplate& kind : ShippedDrillTemplates()) {
    const DrillModel model = kind.Make(1.1, {0.1, -0.05}, 0.05,
                                       {.head_up_m = 0.01, .front_m = -0.01, .foot_fraction = 0.9});
    const SolidTracer tracer(model.parts, {});
    for (int i = 0; i < 150; ++i) {
      const RangeRay ray = RandomRay(random);
      const SolidIntersection intersection = tracer.Intersect(ray, kReach_m);
      const Walk walk = WalkAlong(ray, model);
      if (std::abs(walk.clearance_m) < kStep_m) continue;  // too close for steps to tell
      if (walk.clearance_m < 0.0) {
        ++hits;
        ASSERT_TRUE(intersection.Hits()) << kind.name << ' ' << i;
        EXPECT_NEAR(intersection.range_m, walk.enters_m, 2.0 * kStep_m);
      } else if (walk.clearance_m < kReach_m - kStep_m) {
        ++passes;
        ASSERT_GE(intersection.part, 0) << kind.name << ' ' << i;
        EXPECT_NEAR(intersection.clearance_m, walk.clearance_m, kStep_m);
      } else if (walk.clearance_m > kReach_m + kStep_m) {
        ++misses;
        EXPECT_EQ(intersection.part, -1) << kind.name << ' ' << i;
      }
    }
  }
  EXPECT_GT(hits, 50);
  EXPECT_GT(passes, 50);
  EXPECT_GT(misses, 50);
}

SolidPart Box(double width_m, const Eigen::Vector3d& middle) {
  SolidPart box;
  box.shape = SolidPart::Shape::kBox;
  box.size_m = {width_m, width_m, width_m};
  box.object_from_part = {Eigen::Quaterniond::Identity(), middle};
  return box;
}

TEST(SolidTracer, ThereIsNoEdgeWherePartsStandInEachOther) {
  const RangeRay ray{{-1.0, 0.0, 0.0}, Eigen::Vector3d::UnitX(), 1.0};
  // The ray enters both, one of them 1 mm above its lower face.
  const SolidPart above = Box(0.1, {0.0, 0.0, 0.049}), deeper = Box(0.1, {0.005, 0.0, 0.0});
  const SolidPart alone[] = {above}, both[] = {above, deeper};
  EXPECT_NEAR(SolidTracer(alone, {}).IntersectWithDepth(ray, kReach_m).clearance_m, -0.001, 1e-5);
  const SolidIntersection joined = SolidTracer(both, {}).IntersectWithDepth(ray, kReach_m);
  EXPECT_EQ(joined.clearance_m, -kReach_m) << "as deep as it is asked for";
  EXPECT_NEAR(joined.range_m, 0.95, 1e-9);
}

TEST(SolidTracer, WhatStandsBehindDoesNotMakeAPartWider) {
  const RangeRay ray{{-1.0, 0.0, 0.0}, Eigen::Vector3d::UnitX(), 1.0};
  const SolidPart parts[] = {Box(0.1, {0.0, 0.0, 0.049}), Box(0.1, {0.2, 0.0, 0.0})};
  EXPECT_NEAR(SolidTracer(parts, {}).IntersectWithDepth(ray, kReach_m).clearance_m, -0.001, 1e-5);
}

}  // namespace
}  // namespace foresight
