#include "core/fitting/solids/intersect_columns.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/fitting/solids/solid_tracer.h"
#include "core/objects/drill_template.h"
#include "tests/support/on_every_vector_target.h"

namespace foresight {
namespace {

constexpr int kManyRays = 203;  // some lanes are empty in the end

/// Of a cube about the origin.
Eigen::Vector3d Anywhere(double size, Random& random) {
  return {random.Uniform(-size, size), random.Uniform(-size, size), random.Uniform(-size, size)};
}

/// A few solids of all shapes, about the origin and in each other.
std::vector<SolidPart> SomeSolids(Random& random) {
  std::vector<SolidPart> parts;
  for (const auto shape :
       {SolidPart::Shape::kBox, SolidPart::Shape::kCylinder, SolidPart::Shape::kCapsule}) {
    SolidPart part;
    part.shape = shape;
    part.size_m = Eigen::Vector3d::Constant(0.13) + Anywhere(0.1, random);
    if (shape != SolidPart::Shape::kBox) part.size_m.y() = part.size_m.x();
    part.object_from_part = {
        Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), Anywhere(1.0, random)),
        Anywhere(0.1, random)};
    parts.push_back(part);
  }
  return parts;
}

struct ManyRays {
  std::vector<RangeRay> rays;
  RayColumns columns;
};

ManyRays RaysAbout(double reach_m, Random& random) {
  ManyRays many;
  for (int i = 0; i < kManyRays; ++i) {
    RangeRay ray;
    ray.origin = 1.5 * Anywhere(1.0, random).normalized();
    ray.direction = (Anywhere(0.25, random) - ray.origin).normalized();
    // As straight as a simulator's, every seventh.
    if (i % 7 == 0) {
      ray.origin = {-1.0, random.Uniform(-0.2, 0.2), random.Uniform(-0.2, 0.2)};
      ray.direction = Eigen::Vector3d::UnitX();
    }
    many.rays.push_back(ray);
    many.columns.Add(ray.origin.data(), ray.direction.data(), reach_m);
  }
  many.columns.Pad();
  return many;
}

struct IntersectColumnsTest : OnEveryVectorTarget {
  struct Counts {
    int hits = 0, shallow = 0, passes = 0, misses = 0;
  };
  /// Each ray as SolidTracer has it.
  static void Compare(const std::vector<SolidPart>& parts, const ManyRays& many, double reach_m,
                      Counts& counts) {
    const Rigid<frame::Base, frame::Object> pose(
        Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY())), {0.01, 0.02, 0.0});
    const SolidTracer tracer(parts, pose);
    std::vector<double> clearance_m(many.columns.Padded()), range_m(many.columns.Padded());
    IntersectColumns(tracer.Placed(), many.columns, clearance_m, range_m);
    for (std::size_t i = 0; i < many.rays.size(); ++i) {
      const SolidIntersection alone = tracer.IntersectWithDepth(many.rays[i], reach_m);
      if (alone.part < 0) {
        ++counts.misses;
        EXPECT_TRUE(std::isinf(clearance_m[i])) << i;
        continue;
      }
      ++(!alone.Hits()                  ? counts.passes
         : alone.clearance_m > -reach_m ? counts.shallow
                                        : counts.hits);
      EXPECT_NEAR(clearance_m[i], alone.clearance_m, 2e-7) << i;
      if (alone.Hits()) {
        EXPECT_NEAR(range_m[i], alone.range_m, 1e-10) << i;
        continue;
      }
      // A ray along a face is as near for some way.
      double distance_m = 1.0;
      for (const SolidPart& part : parts)
        distance_m = std::min(
            distance_m, part.Distance(pose.Inverse() *
                                      (many.rays[i].origin + range_m[i] * many.rays[i].direction)));
      EXPECT_NEAR(distance_m, clearance_m[i], 2e-7) << i;
    }
  }
};

TEST_P(IntersectColumnsTest, SeesWhatOneRayAfterAnotherSees) {
  Random random(11);
  Counts counts;
  for (const double reach_m : {0.012, 0.03}) {
    for (int i = 0; i < 12; ++i)
      Compare(SomeSolids(random), RaysAbout(reach_m, random), reach_m, counts);
    for (const DrillTemplate& kind : ShippedDrillTemplates())
      Compare(kind.Make(1.1, {0.1, -0.05}, 0.05, {}).parts, RaysAbout(reach_m, random), reach_m,
              counts);
  }
  EXPECT_GT(counts.hits, 300);
  EXPECT_GT(counts.shallow, 300);
  EXPECT_GT(counts.passes, 300);
  EXPECT_GT(counts.misses, 300);
}

TEST_P(IntersectColumnsTest, WithoutReachWhatMissesIsNotSeen) {
  Random random(12);
  Counts counts;
  for (int i = 0; i < 4; ++i) Compare(SomeSolids(random), RaysAbout(0.0, random), 0.0, counts);
  EXPECT_EQ(counts.passes, 0);
  EXPECT_GT(counts.hits, 100);
}

INSTANTIATE_TEST_SUITE_P(Targets, IntersectColumnsTest, testing::ValuesIn(VectorTargets()),
                         VectorTargetName);

TEST(IntersectColumns, AreTheSameNumbersOnEveryInstructionSet) {
  Random random(13);
  const std::vector<SolidPart> parts = SomeSolids(random);
  const ManyRays many = RaysAbout(0.02, random);
  const PlacedSolids placed = SolidTracer(parts, {}).Placed();
  std::vector<double> first;
  for (const int64_t target : VectorTargets()) {
    const OnlyVectorTarget only(target);
    std::vector<double> numbers(2 * many.columns.Padded());
    const std::span<double> all(numbers);
    IntersectColumns(placed, many.columns, all.first(many.columns.Padded()),
                     all.last(many.columns.Padded()));
    if (first.empty()) first = numbers;
    EXPECT_EQ(numbers, first) << hwy::TargetName(target);
  }
}

}  // namespace
}  // namespace foresight
