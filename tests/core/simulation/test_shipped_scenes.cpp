#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>

#include "core/geometry/angles.h"
#include "core/simulation/ray_caster.h"
#include "tests/core/simulation/small_world.h"

namespace foresight {
namespace {

std::filesystem::path PathOf(const std::string& name) {
  return std::filesystem::path(FORESIGHT_SOURCE_DIR) / "resources/scenes" / (name + ".yaml");
}

/// Sees what the head's camera sees at plate angle 0 (the head's centre moves only millimetres).
class Look {
 public:
  explicit Look(const Scene& scene)
      : caster_(std::make_shared<const Scene>(scene)),
        rig_(DefaultSensorRig()),
        eye_(rig_.robot_from_base * rig_.CameraFromBase(0.0).Inverse().translation()) {}

  /// Whether the first thing on the way to a point lies within `tolerance_m` of it.
  bool Sees(const Eigen::Vector3d& point, double tolerance_m) const {
    const Eigen::Vector3d way = point - eye_;
    const SceneHit hit = caster_.Cast({eye_.cast<float>(), way.normalized().cast<float>()});
    return hit.mesh >= 0 && std::abs(hit.distance_m - way.norm()) < tolerance_m;
  }

  /// The name of the first thing on the way to a point.
  std::string FirstMeshTowards(const Eigen::Vector3d& point) const {
    const SceneHit hit =
        caster_.Cast({eye_.cast<float>(), (point - eye_).normalized().cast<float>()});
    return hit.mesh < 0 ? "" : caster_.scene().meshes[static_cast<std::size_t>(hit.mesh)].name;
  }

  /// The motor angle that puts a point on the image's horizontal middle line, roughly.
  double ElevationDeg(const Eigen::Vector3d& point) const {
    const Eigen::Vector3d way = point - eye_;
    return DegreesFromRadians(std::atan2(way.z(), std::hypot(way.x(), way.y())));
  }

 private:
  RayCaster caster_;
  SensorRig rig_;
  Eigen::Vector3d eye_;
};

double SeenFractionOfRim(const Look& look, const ValveTruth& valve) {
  int seen = 0;
  constexpr int kPoints = 72;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kPoints;
    const Eigen::Vector3d on_rim =
        valve.model.rim_radius_m * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0);
    if (look.Sees(valve.robot_from_object * on_rim, 2.0 * valve.model.tube_radius_m)) ++seen;
  }
  return static_cast<double>(seen) / kPoints;
}

class ShippedScene : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    auto scene = LoadScene(PathOf(GetParam()));
    ASSERT_TRUE(scene.has_value()) << scene.error().message;
    scene_ = std::move(*scene);
  }
  Scene scene_;
};

TEST_P(ShippedScene, ShowsItsObjectsToTheHead) {
  const Look look(scene_);
  EXPECT_FALSE(scene_.valves.empty() && scene_.drills.empty() && scene_.blocks.empty() &&
               scene_.handles.empty());
  for (const ValveTruth& valve : scene_.valves) {
    EXPECT_GE(SeenFractionOfRim(look, valve), 0.95) << valve.name;
    EXPECT_LT(std::abs(look.ElevationDeg(valve.robot_from_object.translation())), 30.0);
  }
  for (const DrillTruth& drill : scene_.drills) {
    const Eigen::Vector3d in_head(0.0, 0.0, 0.208 * drill.scale);
    EXPECT_EQ(look.FirstMeshTowards(drill.robot_from_object * in_head), drill.name + " head");
  }
  for (const HandleTruth& handle : scene_.handles) {
    for (const double fraction : {0.0, 0.5, 1.0})
      EXPECT_TRUE(look.Sees(
          handle.robot_from_object * Eigen::Vector3d(fraction * handle.model.length_m, 0.0, 0.0),
          2.0 * handle.model.radius_m))
          << handle.name;
    EXPECT_LT(std::abs(look.ElevationDeg(handle.robot_from_object.translation())), 30.0);
  }
  for (const BlockTruth& block : scene_.blocks)
    EXPECT_TRUE(look.Sees(block.robot_from_object * Eigen::Vector3d(0.0, 0.05, 0.0), 0.002))
        << block.name;
}

TEST_P(ShippedScene, IsNeitherDarkNorGlaringInTheImage) {
  const World world(std::make_shared<const Scene>(scene_),
                    [] {
                      SensorRig rig = DefaultSensorRig();
                      rig.camera = {.width = 161,
                                    .height = 120,
                                    .fx = 75.0,
                                    .fy = 75.0,
                                    .cx = 80.0,
                                    .cy = 59.5,
                                    .lens = FisheyeLens{0.9413}};
                      return rig;
                    }(),
                    {});
  const CameraFrame frame = world.CaptureImage(0, 0.0, 0.004, 0.0, test::Still, {});
  double sum = 0.0;
  int saturated = 0;
  for (const Rgb8& pixel : frame.image.values()) {
    sum += pixel.g;
    if (pixel.g == 255) ++saturated;
  }
  const auto pixels = static_cast<double>(frame.image.size());
  EXPECT_GT(sum / pixels, 60.0);
  EXPECT_LT(sum / pixels, 200.0);
  EXPECT_LT(saturated / pixels, 0.1);
}

INSTANTIATE_TEST_SUITE_P(All, ShippedScene,
                         testing::Values("valve", "drill", "terrain", "room", "door"),
                         [](const auto& name) { return std::string(name.param); });

TEST(ShippedValveScene, TurnsItsAxisAwayFromTheLineOfSight) {
  const auto scene = LoadScene(PathOf("valve"));
  ASSERT_TRUE(scene.has_value()) << scene.error().message;
  const ValveTruth& valve = scene->valves.front();
  const SensorRig rig = DefaultSensorRig();
  const Eigen::Vector3d to_head =
      rig.robot_from_base.translation() - valve.robot_from_object.translation();
  const double cosine =
      to_head.normalized().dot(valve.robot_from_object.Rotate(Eigen::Vector3d::UnitZ()));
  EXPECT_GT(DegreesFromRadians(std::acos(cosine)), 10.0);
  EXPECT_LT(DegreesFromRadians(std::acos(cosine)), 25.0);
}

}  // namespace
}  // namespace foresight
