#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/geometry/angles.h"
#include "tests/core/simulation/small_world.h"

namespace foresight {
namespace {

using test::Noiseless;
using test::SceneOf;
using test::SmallRig;
using test::Still;

constexpr double kWhiteExposure_s = 0.006;

/// Evenly bright from everywhere: light of `ambient` on a white wall all around.
std::string EvenLight(double ambient) {
  return fmt::format(
      "ambient: {}\n"
      "materials: {{white: {{color: [1, 1, 1]}}}}\n"
      "solids:\n"
      "  - {{shape: plane, size_m: [400, 400], position_m: [2, 0, 0], rpy_deg: [0, 90, 0], "
      "material: "
      "white}}\n",
      ambient);
}

/// Numbers that are proportional to light.
WorldOptions Linear() {
  WorldOptions options = Noiseless();
  options.camera.gamma = 1.0;
  return options;
}

/// The camera's noise alone, without vignetting and with an even chip.
WorldOptions OnlyShotNoise() {
  WorldOptions options = Linear();
  options.camera.enabled = true;
  options.camera.vignetting = 0.0;
  options.camera.pixel_gain_spread = 0.0;
  return options;
}

ColorImage CaptureOf(const World& world, double exposure_s = kWhiteExposure_s, std::int64_t seq = 0,
                     int threads = 1) {
  RunContext context;
  context.threads = threads;
  return world.CaptureImage(seq, 0.0, exposure_s, 0.0, Still, context).image;
}

double MeanRed(const ColorImage& image) {
  double sum = 0.0;
  for (const Rgb8& pixel : image.values()) sum += pixel.r;
  return sum / static_cast<double>(image.size());
}

TEST(TrueDepth, OfASphereIsExact) {
  const World world(
      SceneOf("materials: {a: {}}\nsolids:\n"
              "  - {shape: sphere, radius_m: 0.5, position_m: [2, 0.1, 0.05], material: a}\n"),
      SmallRig(), Noiseless());
  const SensorRig& rig = world.true_rig();
  const auto camera_from_robot = rig.CameraFromBase(0.0) * rig.robot_from_base.Inverse();
  const Eigen::Vector3d center = camera_from_robot * Eigen::Vector3d(2.0, 0.1, 0.05);
  const DepthImage depth = world.TrueDepth(0.0, {});
  int compared = 0;
  for (int y = 0; y < depth.height(); ++y) {
    for (int x = 0; x < depth.width(); ++x) {
      const Eigen::Vector3d ray = *rig.camera.Unproject(Eigen::Vector2d(x, y));
      const double along = ray.dot(center);
      const double miss2 = center.squaredNorm() - along * along;
      if (miss2 > 0.26) {
        EXPECT_TRUE(std::isnan(depth(x, y))) << x << ", " << y;
      }
      if (miss2 > 0.20) continue;  // near the outline the mesh's 0.3 mm grow without limit
      const double expected = (along - std::sqrt(0.25 - miss2)) * ray.z();
      ASSERT_NEAR(depth(x, y), expected, 0.001) << x << ", " << y;
      ++compared;
    }
  }
  EXPECT_GT(compared, 100);
}

TEST(TrueDepth, FollowsThePlateAndNotTheShaft) {
  WorldOptions options = Noiseless();
  options.motor.enabled = true;
  options.motor.amplitude1_rad = 0.05;
  const std::string scene =
      "materials: {a: {}}\nsolids:\n"
      "  - {shape: plane, size_m: [40, 40], position_m: [0, 0, -1], material: a}\n";
  const World world(SceneOf(scene), SmallRig(), options);
  const double motor_rad = -0.5;
  SensorRig rig = world.true_rig();
  const auto robot_from_camera = rig.robot_from_base *
                                 HeadFromBase(world.PlateAngle(motor_rad, true)).Inverse() *
                                 rig.camera_from_head.Inverse();
  const Eigen::Vector3d ray = *rig.camera.Unproject({31.0, 30.0});
  const double along =
      (-1.0 - robot_from_camera.translation().z()) / robot_from_camera.Rotate(ray).z();
  EXPECT_NEAR(world.TrueDepth(motor_rad, {})(31, 30), along * ray.z(), 1e-4);
}

TEST(TrueDepth, DoesNotDependOnTheNumberOfThreads) {
  const World world(SceneOf(EvenLight(1.0)), SmallRig(), {});
  RunContext one;
  one.threads = 1;
  RunContext two;
  two.threads = 2;
  EXPECT_EQ(world.TrueDepth(0.1, one), world.TrueDepth(0.1, two));
}

TEST(SimulatedCamera, AWhiteSurfaceTwoMetresFromLightOneGivesHalfTheRangeAtHalfTheExposure) {
  // The lamp sits in the camera's eye: (0.04, 0, 0.035) in robot.
  const World world(
      SceneOf("ambient: 0\nlights: [{position_m: [0.04, 0, 0.035], intensity: 1}]\n"
              "materials: {white: {color: [1, 1, 1]}}\nsolids:\n"
              "  - {shape: plane, size_m: [9, 9], position_m: [2.04, 0, 0], rpy_deg: [0, 90, 0], "
              "material: white}\n"),
      SmallRig(), Linear());
  EXPECT_NEAR(CaptureOf(world, 0.5 * kWhiteExposure_s)(32, 24).r, 127.5, 1.5);
}

TEST(SimulatedCamera, AShadowLeavesOnlyTheLightFromEverywhere) {
  const std::string wall =
      "ambient: 0.25\nlights: [{position_m: [0.5, 0, 1.5], intensity: 1}]\n"
      "materials: {white: {color: [1, 1, 1]}}\nsolids:\n"
      "  - {shape: plane, size_m: [9, 9], position_m: [2, 0, 0], rpy_deg: [0, 90, 0], material: "
      "white}\n";
  const std::string shelf =
      "  - {shape: box, size_m: [0.8, 4, 0.01], position_m: [1.6, 0, 0.6], material: white}\n";
  const World open(SceneOf(wall), SmallRig(), Linear());
  const World shaded(SceneOf(wall + shelf), SmallRig(), Linear());
  // A wall gets 0.8 of the light from everywhere.
  EXPECT_NEAR(CaptureOf(shaded)(32, 24).r, 0.25 * 0.8 * 255.0, 1.0);
  EXPECT_GT(CaptureOf(open)(32, 24).r, 100);
}

TEST(SimulatedCamera, ShotNoiseIsTheSquareRootOfTheElectrons) {
  const World world(SceneOf(EvenLight(0.625)), SmallRig(), OnlyShotNoise());
  const ColorImage image = CaptureOf(world);  // 0.625 * 0.8 = half the full well
  const double mean = MeanRed(image);
  double variance = 0.0;
  for (const Rgb8& pixel : image.values())
    variance += (pixel.r - mean) * (pixel.r - mean) / static_cast<double>(image.size());
  const double electrons = 3500.0 + 8.0 * 8.0;
  const double stated = std::sqrt(electrons * 255.0 * 255.0 / (7000.0 * 7000.0) + 1.0 / 12.0);
  // 3072 samples give sigma to 1.3 %.
  EXPECT_NEAR(std::sqrt(variance), stated, 0.05 * stated);
}

TEST(SimulatedCamera, LosesTheStatedFractionOfLightAtTheCorner) {
  WorldOptions options = OnlyShotNoise();
  options.camera.vignetting = 0.3;
  options.camera.full_well_e = 1e12;  // leaves no noise to see
  const World world(SceneOf(EvenLight(1.0)), SmallRig(), options);
  const ColorImage image = CaptureOf(world);
  EXPECT_NEAR(image(0, 0).r / static_cast<double>(image(32, 24).r), 0.7, 0.01);
}

TEST(SimulatedCamera, PixelGainsBelongToTheChip) {
  WorldOptions options = OnlyShotNoise();
  options.camera.full_well_e = 1e12;
  options.camera.pixel_gain_spread = 0.1;
  const World world(SceneOf(EvenLight(0.5)), SmallRig(), options);
  options.seed = 2;
  const World other_chip(SceneOf(EvenLight(0.5)), SmallRig(), options);
  EXPECT_EQ(CaptureOf(world, kWhiteExposure_s, 1), CaptureOf(world, kWhiteExposure_s, 2));
  EXPECT_NE(CaptureOf(world, kWhiteExposure_s, 1), CaptureOf(other_chip, kWhiteExposure_s, 1));
}

TEST(SimulatedCamera, SixDecibelsDoubleTheNumbers) {
  const World world(SceneOf(EvenLight(0.5)), SmallRig(), Linear());
  const double plain = MeanRed(world.CaptureImage(0, 0.0, 0.003, 0.0, Still, {}).image);
  const double gained = MeanRed(world.CaptureImage(0, 0.0, 0.003, 6.0206, Still, {}).image);
  EXPECT_NEAR(gained / plain, 2.0, 0.02);
}

TEST(SimulatedCamera, ATurningPlateBlursAnEdgeAcrossItsWay) {
  // Bright above the horizon, dark below; 300 px to the radian, so 0.72 deg of way are 3.8 px.
  SensorRig rig = SmallRig();
  rig.camera = {.width = 8,
                .height = 64,
                .fx = 300.0,
                .fy = 300.0,
                .cx = 3.5,
                .cy = 31.5,
                .lens = FisheyeLens{0.9413}};
  const World world(
      SceneOf(
          "ambient: 1\nmaterials: {white: {color: [1, 1, 1]}, black: {color: [0, 0, 0]}}\nsolids:\n"
          "  - {shape: box, size_m: [0.1, 9, 4], position_m: [2, 0, 2], material: white}\n"
          "  - {shape: box, size_m: [0.1, 9, 4], position_m: [2, 0, -2], material: black}\n"),
      rig, Linear());
  const auto grey_rows = [&](const std::function<double(double)>& motor_rad_at) {
    const CameraFrame frame = world.CaptureImage(0, 0.0, 0.006, 0.0, motor_rad_at, {});
    int rows = 0;
    for (int y = 0; y < 64; ++y) {
      int sum = 0;
      for (int x = 0; x < 8; ++x) sum += frame.image(x, y).r;
      if (sum > 8 * 10 && sum < 8 * 190) ++rows;
    }
    return rows;
  };
  EXPECT_LE(grey_rows(Still), 1);
  const double speed_rad_s = RadiansFromDegrees(120.0);
  EXPECT_GE(grey_rows([&](double t) { return speed_rad_s * t; }), 3);
}

TEST(SimulatedCamera, ReportsTheEncodersAngleAtMidExposure) {
  const World world(SceneOf(EvenLight(0.5)), SmallRig(), {});
  const auto motor_rad_at = [](double time_s) { return 0.1 * time_s; };
  const CameraFrame frame = world.CaptureImage(3, 2.0, 0.004, 0.0, motor_rad_at, {});
  EXPECT_EQ(frame.motor_angle_rad, world.EncoderAngle(0.2));
  EXPECT_EQ(frame.time_s, 2.0);
}

TEST(SimulatedCamera, DoesNotDependOnTheNumberOfThreads) {
  const World world(SceneOf(EvenLight(0.5)), SmallRig(), {});
  EXPECT_EQ(CaptureOf(world, 0.004, 5, 1), CaptureOf(world, 0.004, 5, 2));
}

TEST(SimulatedCamera, ImagesAndSeedsDifferInTheirNoise) {
  const World one(SceneOf(EvenLight(0.5)), SmallRig(),
                  {.seed = 1, .lidar = {}, .camera = {}, .motor = {}});
  const World two(SceneOf(EvenLight(0.5)), SmallRig(),
                  {.seed = 2, .lidar = {}, .camera = {}, .motor = {}});
  EXPECT_NE(CaptureOf(one, 0.004, 1), CaptureOf(one, 0.004, 2));
  EXPECT_NE(CaptureOf(one, 0.004, 1), CaptureOf(two, 0.004, 1));
}

TEST(SimulatedCamera, GivesNoImageWhenCancelled) {
  const World world(SceneOf(EvenLight(0.5)), SmallRig(), {});
  std::stop_source source;
  source.request_stop();
  RunContext context;
  context.stop = source.get_token();
  EXPECT_TRUE(world.CaptureImage(0, 0.0, 0.004, 0.0, Still, context).image.empty());
  EXPECT_TRUE(world.TrueDepth(0.0, context).empty());
}

TEST(SimulatedCamera, ACheckerboardShowsBothColoursAlternately) {
  SensorRig rig = SmallRig();
  const World world(
      SceneOf(
          "ambient: 1\nmaterials: {board: {color: [1, 1, 1], pattern: checker, color2: [0, 0, 0], "
          "pattern_size_m: 0.5}}\nsolids:\n"
          "  - {shape: plane, size_m: [20, 20], position_m: [2, 0, 0], rpy_deg: [0, 90, 0], "
          "material: board}\n"),
      rig, Linear());
  const ColorImage image = CaptureOf(world);
  const auto at = [&](double y_m, double z_m) {
    const auto camera_from_robot = rig.CameraFromBase(0.0) * rig.robot_from_base.Inverse();
    const Eigen::Vector2d pixel =
        *rig.camera.Project(camera_from_robot * Eigen::Vector3d(2.0, y_m, z_m));
    return image(static_cast<int>(std::lround(pixel.x())), static_cast<int>(std::lround(pixel.y())))
        .r;
  };
  EXPECT_EQ(at(0.25, 0.25), at(-0.25, -0.25));
  EXPECT_EQ(at(0.25, -0.25), at(-0.25, 0.25));
  EXPECT_GT(std::abs(at(0.25, 0.25) - at(-0.25, 0.25)), 150);
}

}  // namespace
}  // namespace foresight
