#include "core/fitting/cylinder/fit_cylinder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "core/base/random.h"
#include "core/fitting/roi.h"
#include "core/geometry/angles.h"
#include "core/simulation/ray_caster.h"
#include "core/simulation/shapes.h"

namespace foresight {
namespace {

using Pose = Rigid<frame::Robot, frame::Object>;

/// Something before a wall and on the ground as a lidar at the origin sees it; x ahead, z up.
struct View {
  Shape shape;
  Pose at;
  double wall_m = 0.0;               ///< ahead; 0 = none
  double ground_m = 0.0;             ///< its height; 0 = none
  std::optional<Shape> behind = {};  ///< something else
  Pose behind_at;
  double half_rad = 0.2;  ///< of the view, about the thing
  double spacing_rad = 0.006;
  double sigma_m = 0.010;
  std::uint64_t seed = 1;
};

void AddSolid(const Shape& shape, const Pose& at, Scene& scene) {
  SceneMesh mesh;
  mesh.robot_from_object = at;
  AppendShape(shape, at, mesh);
  scene.meshes.push_back(std::move(mesh));
}

Pose At(double x, double y, double z) {
  return Pose(Eigen::Quaterniond::Identity(), {x, y, z});
}

/// In the view's own frame: base and robot are the same here, and up is z.
RaySet RaysOf(const View& view) {
  auto scene = std::make_shared<Scene>();
  AddSolid(view.shape, view.at, *scene);
  if (view.wall_m > 0.0)
    AddSolid(BoxShape({0.1, 20.0, 20.0}), At(view.wall_m + 0.05, 0.0, 0.0), *scene);
  if (view.ground_m != 0.0)
    AddSolid(BoxShape({40.0, 40.0, 0.1}), At(0.0, 0.0, view.ground_m - 0.05), *scene);
  if (view.behind) AddSolid(*view.behind, view.behind_at, *scene);
  const RayCaster caster(scene);
  Random random(view.seed);
  const Eigen::Vector3d middle = view.at.translation();
  const double left = std::atan2(middle.y(), middle.x());
  const double rise = std::atan2(middle.z(), middle.head<2>().norm());
  RaySet set;
  set.sigma_m = 0.010;
  set.footprint_rad = view.spacing_rad;
  for (double up = rise - view.half_rad; up < rise + view.half_rad; up += view.spacing_rad)
    for (double aside = left - view.half_rad; aside < left + view.half_rad;
         aside += view.spacing_rad) {
      const Eigen::Vector3d direction(std::cos(up) * std::cos(aside),
                                      std::cos(up) * std::sin(aside), std::sin(up));
      const SceneHit hit =
          caster.Cast({Eigen::Vector3f::Zero(), direction.cast<float>().normalized()});
      if (hit.distance_m > 0.0f && hit.distance_m < 30.0f)
        set.rays.push_back(
            {Eigen::Vector3d::Zero(), direction, hit.distance_m + view.sigma_m * random.Normal()});
    }
  return set;
}

Result<CylinderDetection> Fit(const RaySet& rays) {
  FitCylinderOptions options;
  options.up = Eigen::Vector3d::UnitZ();
  return FitCylinder(rays, options, {});
}

double AxisError_deg(const CylinderDetection& found, const Pose& truth) {
  const Eigen::Vector3d axis = found.base_from_object.Rotate(Eigen::Vector3d::UnitZ());
  return DegreesFromRadians(
      std::acos(std::min(1.0, std::abs(axis.dot(truth.Rotate(Eigen::Vector3d::UnitZ()))))));
}

/// Distance of the found middle from the true axis.
double AcrossError_m(const CylinderDetection& found, const Pose& truth) {
  return (truth.Inverse() * found.base_from_object.translation()).head<2>().norm();
}

TEST(FitCylinder, APoleOnTheGroundBeforeAWall) {
  View view;
  view.shape = CylinderShape(0.12, 2.0);
  view.at = At(4.0, 0.5, 0.0);
  view.wall_m = 6.0;
  view.ground_m = -1.0;
  view.half_rad = 0.28;
  const auto found = Fit(RaysOf(view));
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_EQ(found->verdict.level, VerdictLevel::kLikely) << found->verdict.reason;
  // Beams are 24 mm apart there: an edge is known to about half of that.
  EXPECT_NEAR(found->model.radius_m, 0.12, 0.012);
  EXPECT_LT(AcrossError_m(*found, view.at), 0.015);
  EXPECT_LT(AxisError_deg(*found, view.at), 1.5);
  EXPECT_LT(found->evidence.see_through, 0.05);
  EXPECT_NEAR(found->evidence.range_sigma_m, view.sigma_m, 0.005);
}

TEST(FitCylinder, ALidSaysNothingOfItsGirth) {
  // Half of a barrel is seen from one place at most, and its lid as well from above.
  View view;
  view.shape = CylinderShape(0.28, 0.85);
  view.at = At(2.2, 0.0, -0.80);
  view.ground_m = -1.225;
  view.half_rad = 0.30;
  const auto found = Fit(RaysOf(view));
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_NEAR(found->model.radius_m, 0.28, 0.02);
  EXPECT_LT(DegreesFromRadians(found->evidence.seen_arc_rad), 180.0);
  EXPECT_GT(DegreesFromRadians(found->evidence.seen_arc_rad), 120.0);
}

TEST(FitCylinder, ALeaningPipeAndOneThatLiesAlongAWall) {
  View leaning;
  leaning.shape = CylinderShape(0.05, 1.2);
  leaning.at =
      Pose(Eigen::Quaterniond(Eigen::AngleAxisd(0.6, Eigen::Vector3d(1, 1, 0).normalized())),
           {2.0, -0.2, 0.1});
  leaning.wall_m = 3.0;
  leaning.half_rad = 0.25;
  View lying = leaning;
  lying.at = Pose(Eigen::Quaterniond(Eigen::AngleAxisd(1.5708, Eigen::Vector3d::UnitX())),
                  {2.0, 0.0, 0.3});
  lying.wall_m = 2.08;
  for (const View& view : {leaning, lying}) {
    const auto found = Fit(RaysOf(view));
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_NEAR(found->model.radius_m, 0.05, 0.008);
    EXPECT_LT(AcrossError_m(*found, view.at), 0.010);
    EXPECT_LT(AxisError_deg(*found, view.at), 2.0);
  }
}

TEST(FitCylinder, ItsUpIsZAndItsOriginTheMiddleOfWhatIsSeen) {
  View view;
  view.shape = CylinderShape(0.10, 0.8);
  view.at = At(3.0, 0.0, 0.0);
  view.wall_m = 4.0;
  const auto found = Fit(RaysOf(view));
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_GT(found->base_from_object.Rotate(Eigen::Vector3d::UnitZ()).z(), 0.99);
  EXPECT_NEAR(found->base_from_object.translation().z(), 0.0, 0.02);
  EXPECT_NEAR(found->model.length_m, 0.8, 0.04);
}

TEST(FitCylinder, BeamsThatWentPastFixTheRadiusOfANoisyPole) {
  // At 30 mm of noise ranges alone leave a circle of 100 mm open; its outline does not.
  View view;
  view.shape = CylinderShape(0.10, 1.6);
  view.at = At(4.0, 0.0, 0.0);
  view.wall_m = 6.0;
  view.sigma_m = 0.030;
  double sum = 0.0;
  constexpr int kSeeds = 5;
  for (view.seed = 1; view.seed <= kSeeds; ++view.seed) {
    const auto found = Fit(RaysOf(view));
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_NEAR(found->model.radius_m, 0.10, 0.015) << view.seed;
    EXPECT_NEAR(found->evidence.range_sigma_m, 0.030, 0.008);
    sum += found->model.radius_m;
  }
  // Drawn beams have no width, the fit thinks they have one: half of 24 mm.
  EXPECT_NEAR(sum / kSeeds, 0.10, 0.012);
}

TEST(FitCylinder, AWallAndABoxAreNotLikely) {
  View wall;
  wall.shape = BoxShape({0.1, 6.0, 6.0});
  wall.at = At(3.0, 0.0, 0.0);
  View box = wall;
  box.shape = BoxShape({0.4, 0.4, 0.5});
  box.at = Pose(Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ())), {3.0, 0, 0});
  box.wall_m = 4.0;
  for (const View& view : {wall, box}) {
    const auto found = Fit(RaysOf(view));
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_EQ(found->verdict.level, VerdictLevel::kUnsure) << found->model.radius_m;
    EXPECT_FALSE(found->verdict.reason.empty());
  }
}

TEST(FitCylinder, AMugIsFoundOnATableThatIsRoundToTheLikelihood) {
  View view;
  view.shape = CylinderShape(0.042, 0.10);
  view.at = At(1.2, 0.0, -0.5);
  view.ground_m = -0.55;
  view.half_rad = 0.12;
  view.spacing_rad = 0.004;
  for (view.seed = 1; view.seed <= 6; ++view.seed) {
    const auto found = Fit(RaysOf(view));
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_NEAR(found->model.radius_m, 0.042, 0.006) << view.seed;
    EXPECT_EQ(found->verdict.level, VerdictLevel::kLikely) << found->verdict.reason;
  }
}

TEST(FitCylinder, WhatStandsBehindTheDrawnBoxIsNotTheAnswer) {
  // A pole in the box, and a larger barrel behind it, on which more of the beams end.
  View view;
  view.shape = CylinderShape(0.03, 0.12);
  view.at = At(1.5, 0.0, 0.0);
  view.half_rad = 0.16;
  view.behind = CylinderShape(0.20, 1.0);
  view.behind_at = At(2.4, 0.1, 0.0);
  RaySet rays = RaysOf(view);
  BoxRoi box;
  box.base_from_box = {Eigen::Quaterniond::Identity(), view.at.translation()};
  box.size_m = {0.2, 0.2, 0.2};
  std::erase_if(rays.rays, [&](const RangeRay& ray) {
    return !box.Crosses(ray.origin, ray.origin + ray.range_m * ray.direction);
  });
  rays.box = box;
  const auto found = Fit(rays);
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_NEAR(found->model.radius_m, 0.03, 0.006);
  EXPECT_EQ(found->evidence.in_drawn_box, 1.0);
}

TEST(FitCylinder, TheSameSeedGivesTheSameAnswer) {
  View view;
  view.shape = CylinderShape(0.12, 1.0);
  view.at = At(3.0, 0.0, 0.0);
  const RaySet rays = RaysOf(view);
  const auto once = Fit(rays), again = Fit(rays);
  ASSERT_TRUE(once && again);
  EXPECT_EQ(once->model.radius_m, again->model.radius_m);
  EXPECT_EQ(once->base_from_object.translation(), again->base_from_object.translation());
}

TEST(FitCylinder, RefusesTooFewRaysNaNOptionsThatAreNoneAndACancelledOne) {
  View view;
  view.shape = CylinderShape(0.12, 1.0);
  view.at = At(3.0, 0.0, 0.0);
  RaySet rays = RaysOf(view);
  FitCylinderOptions options;
  options.min_radius_m = 1.0;
  EXPECT_EQ(FitCylinder(rays, options, {}).error().code, ErrorCode::kInvalidOptions);
  std::stop_source stop;
  stop.request_stop();
  RunContext cancelled;
  cancelled.stop = stop.get_token();
  EXPECT_EQ(FitCylinder(rays, {}, cancelled).error().code, ErrorCode::kCancelled);
  for (RangeRay& ray : rays.rays) ray.range_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(Fit(rays).error().code, ErrorCode::kTooFewPoints);
  rays.rays.clear();
  EXPECT_EQ(Fit(rays).error().code, ErrorCode::kTooFewPoints);
}

}  // namespace
}  // namespace foresight
