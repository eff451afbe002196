#include "core/fitting/valve/valve_tracer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"

namespace foresight {
namespace {

/// A dished wheel around the origin, looked at from 1 m under a view angle.
struct Case {
  ValveCandidate valve;
  Eigen::Vector3d eye;
};

Case MakeCase(Random& random, int spokes) {
  Case c;
  c.valve.model = UsualValve(0.15, 0.012, spokes, 0.03);
  const double view = random.Uniform(0.0, 0.7);
  const double way = random.Uniform(0.0, 6.28);
  c.eye = {std::sin(view) * std::cos(way), std::sin(view) * std::sin(way), std::cos(view)};
  return c;
}

RangeRay RandomRay(Random& random, const Eigen::Vector3d& eye) {
  const Eigen::Vector3d target(random.Uniform(-0.2, 0.2), random.Uniform(-0.2, 0.2), 0.0);
  return {eye, (target - eye).normalized(), 1.0};
}

/// Range of the first surface, and the closest approach, by tracing spheres.
struct Traced {
  bool hit = false;
  double range_m = 0.0;
  double closest_m = 1e9;
};

Traced SphereTrace(const ValveModel& model, const RangeRay& ray) {
  Traced traced;
  double t = 0.5;
  while (t < 1.6) {
    const double distance = model.Distance(ray.origin + t * ray.direction);
    traced.closest_m = std::min(traced.closest_m, distance);
    if (distance < 1e-6) return {true, t, 0.0};
    t += std::min(distance, 0.002);
  }
  return traced;
}

TEST(ValveTracer, IntersectsTheTemplateWhereSphereTracingDoes) {
  Random random(7);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Case c = MakeCase(random, std::array{0, 2, 3, 4, 5, 6}[i % 6]);
    const RangeRay ray = RandomRay(random, c.eye);
    const Traced traced = SphereTrace(c.valve.model, ray);
    const ValveIntersection intersection = ValveTracer(c.valve, ValveParts::kAll).Intersect(ray);
    // A grazing ray may be decided either way within a tenth of a tube.
    if (std::abs(intersection.Clearance()) < 0.002) continue;
    EXPECT_EQ(intersection.Clearance() < 0.0, traced.hit);
    if (!traced.hit || intersection.Clearance() > 0.0) continue;
    ++hits;
    // Tubes are taken as straight where the ray intersects them: a few millimetres at a tube's
    // flank, well below the range noise.
    EXPECT_NEAR(intersection.Range(), traced.range_m, 0.004);
  }
  EXPECT_GT(hits, 300);
}

TEST(ValveTracer, IntersectsFlatAndUprightSectionsWhereSphereTracingDoes) {
  Random random(11);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    Case c = MakeCase(random, 2 + i % 5);
    c.valve.model.rim_depth_ratio = random.Uniform(0.3, 2.5);
    c.valve.model.spoke_depth_ratio = random.Uniform(0.3, 2.5);
    const RangeRay ray = RandomRay(random, c.eye);
    const Traced traced = SphereTrace(c.valve.model, ray);
    const ValveIntersection intersection = ValveTracer(c.valve, ValveParts::kAll).Intersect(ray);
    if (std::abs(intersection.Clearance()) < 0.002) continue;
    EXPECT_EQ(intersection.Clearance() < 0.0, traced.hit);
    if (!traced.hit || intersection.Clearance() > 0.0) continue;
    ++hits;
    EXPECT_NEAR(intersection.Range(), traced.range_m, 0.005);
  }
  EXPECT_GT(hits, 300);
}

TEST(ValveTracer, IntersectsALeverWhereSphereTracingDoes) {
  Random random(10);
  int hits = 0;
  int on_head = 0;
  for (int i = 0; i < 2000; ++i) {
    Case c = MakeCase(random, 2);
    c.valve.model = UsualLever(0.2, 0.012, 0.025);
    const RangeRay ray = RandomRay(random, c.eye);
    const Traced traced = SphereTrace(c.valve.model, ray);
    const ValveIntersection intersection = ValveTracer(c.valve, ValveParts::kAll).Intersect(ray);
    if (std::abs(intersection.Clearance()) < 0.002) continue;
    EXPECT_EQ(intersection.Clearance() < 0.0, traced.hit);
    if (!traced.hit || intersection.Clearance() > 0.0) continue;
    ++hits;
    if (intersection.part == ValvePart::kHub) ++on_head;
    // The stem that leads back from the head must not be intersected before it; of its far end's
    // flank little is seen.
    const double tolerance_m = intersection.part == ValvePart::kStem ? 0.010 : 0.004;
    EXPECT_NEAR(intersection.Range(), traced.range_m, tolerance_m);
  }
  EXPECT_GT(hits, 60);
  EXPECT_GT(on_head, 15);
}

TEST(ValveTracer, KnowsHowFarARayPassesBy) {
  Random random(8);
  int near = 0;
  for (int i = 0; i < 1000; ++i) {
    const Case c = MakeCase(random, 4);
    const RangeRay ray = RandomRay(random, c.eye);
    const Traced traced = SphereTrace(c.valve.model, ray);
    const ValveIntersection intersection = ValveTracer(c.valve, ValveParts::kAll).Intersect(ray);
    if (traced.hit || intersection.Clearance() < 0.0) continue;
    if (traced.closest_m > 0.03) continue;  // beyond, no footprint reaches
    ++near;
    EXPECT_NEAR(intersection.Clearance(), traced.closest_m, 0.002);
  }
  EXPECT_GT(near, 100);
}

TEST(ValveTracer, NeverSkipsARayThatIntersectsTheValve) {
  Random random(9);
  int intersecting = 0, skipped = 0;
  for (int i = 0; i < 1000; ++i) {
    const Case c = MakeCase(random, 3);
    const RangeRay ray = RandomRay(random, c.eye);
    const ValveTracer tracer(c.valve, ValveParts::kAll);
    const bool near = tracer.Near(ray, 0.01);
    skipped += near ? 0 : 1;
    if (tracer.Intersect(ray).Clearance() > 0.01) continue;
    ++intersecting;
    EXPECT_TRUE(near);
  }
  EXPECT_GT(intersecting, 100);
  EXPECT_GT(skipped, 100) << "who skips no ray skips none that intersects";
}

TEST(ValveTracer, WithinReachNothingIsSkipped) {
  constexpr double kReach_m = 0.012;
  Random random(10);
  int within = 0, beyond = 0;
  for (int i = 0; i < 4000; ++i) {
    Case c = MakeCase(random, 2 + i % 4);
    c.valve.model.rim_depth_ratio = random.Uniform(0.5, 3.0);
    const RangeRay ray = RandomRay(random, c.eye);
    const ValveTracer tracer(c.valve, i % 5 == 0 ? ValveParts::kRim : ValveParts::kAll);
    const ValveIntersection all = tracer.Intersect(ray);
    const ValveIntersection some = tracer.Intersect(ray, kReach_m);
    if (all.Clearance() > kReach_m) {
      ++beyond;
      EXPECT_GT(some.Clearance(), kReach_m);
      continue;
    }
    ++within;
    EXPECT_EQ(some.part, all.part);
    EXPECT_EQ(some.Clearance(), all.Clearance());
    EXPECT_EQ(some.Range(), all.Range());
  }
  EXPECT_GT(within, 500);
  EXPECT_GT(beyond, 500);
}

}  // namespace
}  // namespace foresight
