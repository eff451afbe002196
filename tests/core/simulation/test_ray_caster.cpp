#include "core/simulation/ray_caster.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/base/random.h"
#include "tests/core/simulation/small_world.h"

namespace foresight {
namespace {

constexpr const char* kBallBeforeAWall =
    "materials: {grey: {}}\n"
    "solids:\n"
    "  - {shape: sphere, radius_m: 0.5, position_m: [2, 0, 0], material: grey}\n"
    "  - {shape: plane, size_m: [6, 6], position_m: [5, 0, 0], rpy_deg: [0, 90, 0], material: "
    "grey}\n";

TEST(RayCaster, MeasuresTheDistanceToASphere) {
  const RayCaster caster(test::SceneOf(kBallBeforeAWall));
  const SceneHit hit = caster.Cast({{0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}});
  EXPECT_EQ(hit.mesh, 0);
  // The flats of the mesh lie up to 0.27 mm inside a sphere of 0.5 m.
  EXPECT_NEAR(hit.distance_m, 1.5, 3e-4);
}

TEST(RayCaster, TurnsTheNormalTowardsTheRaysOriginFromEitherSide) {
  const RayCaster caster(test::SceneOf(kBallBeforeAWall));
  const SceneHit front = caster.Cast({{4.0f, 0.0f, 2.0f}, {1.0f, 0.0f, 0.0f}});
  const SceneHit back = caster.Cast({{6.0f, 0.0f, 2.0f}, {-1.0f, 0.0f, 0.0f}});
  EXPECT_NEAR(front.normal.x(), -1.0, 1e-6);
  EXPECT_NEAR(back.normal.x(), 1.0, 1e-6);
}

TEST(RayCaster, SaysWhetherASolidIsHitFromInside) {
  const RayCaster caster(test::SceneOf(kBallBeforeAWall));
  EXPECT_FALSE(caster.Cast({{0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}}).from_behind);
  EXPECT_TRUE(caster.Cast({{2.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}}).from_behind);
}

TEST(RayCaster, SaysNaNWhereThereIsNothing) {
  const RayCaster caster(test::SceneOf(kBallBeforeAWall));
  const SceneHit hit = caster.Cast({{0.0f, 0.0f, 0.0f}, {-1.0f, 0.0f, 0.0f}});
  EXPECT_EQ(hit.mesh, -1);
  EXPECT_TRUE(std::isnan(hit.distance_m));
}

TEST(RayCaster, PacketsAnswerAsSingleRaysDo) {
  const RayCaster caster(test::SceneOf(kBallBeforeAWall));
  Random random(3);
  std::vector<SceneRay> rays(1003);  // the last packet is not full
  for (SceneRay& ray : rays)
    ray = {Eigen::Vector3f::Zero(),
           Eigen::Vector3d(1.0, random.Uniform(-1.0, 1.0), random.Uniform(-1.0, 1.0))
               .normalized()
               .cast<float>()};
  std::vector<SceneHit> hits(rays.size());
  caster.Cast(rays, hits);
  int hit = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const SceneHit single = caster.Cast(rays[i]);
    ASSERT_EQ(hits[i].mesh, single.mesh) << i;
    if (single.mesh < 0) continue;
    ++hit;
    ASSERT_NEAR(hits[i].distance_m, single.distance_m, 1e-5) << i;
  }
  EXPECT_GT(hit, 100);
}

TEST(RayCaster, OcclusionEndsAtTheGivenDistance) {
  const RayCaster caster(test::SceneOf(kBallBeforeAWall));
  const SceneRay ray{{0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}};
  EXPECT_FALSE(caster.Occluded(ray, 1.4f));
  EXPECT_TRUE(caster.Occluded(ray, 1.6f));
}

TEST(RayCaster, OcclusionPacketsAnswerAsSingleRaysDo) {
  const RayCaster caster(test::SceneOf(kBallBeforeAWall));
  const std::vector<SceneRay> rays(13, {{0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}});
  std::vector<float> distances;
  for (std::size_t i = 0; i < rays.size(); ++i) distances.push_back(i % 3 == 0 ? 1.6f : 1.4f);
  std::vector<std::uint8_t> occluded(rays.size());
  caster.Occluded(rays, distances, occluded);
  for (std::size_t i = 0; i < rays.size(); ++i) EXPECT_EQ(occluded[i], i % 3 == 0 ? 1 : 0) << i;
}

TEST(RayCaster, AnEmptySceneHasNothingToHit) {
  const RayCaster caster(std::make_shared<const Scene>());
  EXPECT_EQ(caster.Cast({{0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}}).mesh, -1);
}

}  // namespace
}  // namespace foresight
