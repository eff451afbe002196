// What the lidar's simulator can be made to do beyond its defaults.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/core/simulation/small_world.h"

namespace foresight {
namespace {

using test::BeamOf;
using test::Noiseless;
using test::SceneOf;
using test::SmallRig;
using test::Still;

constexpr int kStraightAhead = 540;  ///< the beam at 0 deg

/// Planes across the beam at 0 deg, each of a material written as YAML; the first is the nearest.
std::string Planes(const std::vector<std::pair<double, std::string>>& planes) {
  std::string materials = "materials:\n", solids = "solids:\n";
  int i = 0;
  for (const auto& [x_m, material] : planes) {
    materials += fmt::format("  m{}: {{{}}}\n", i, material);
    solids += fmt::format(
        "  - {{shape: plane, size_m: [40, 40], position_m: [{}, 0, 0], rpy_deg: [0, 90, 0], "
        "material: m{}}}\n",
        x_m, i++);
  }
  return materials + solids;
}

/// Footprints and echoes, no noise.
WorldOptions WithoutNoise() {
  WorldOptions options = Noiseless();
  options.lidar = {.sigma_base_m = 0.0,
                   .sigma_per_metre = 0.0,
                   .sigma_at_threshold_m = 0.0,
                   .walk_at_threshold_m = 0.0,
                   .spurious_fraction = 0.0,
                   .enabled = true};
  return options;
}

double Forward(const World& world) {
  return world.MeasureLine(0, 0.0, Still).RawRange(kStraightAhead) +
         BeamOf(SmallRig(), kStraightAhead, 0.0).origin.x();
}

TEST(LidarOptions, ABlackWallReadsLongerThanAWhiteOne) {
  WorldOptions options = WithoutNoise();
  options.lidar.walk_of_black_m = 0.020;
  const auto at = [&](const char* material) {
    return Forward(World(SceneOf(Planes({{3.0, material}})), SmallRig(), options));
  };
  EXPECT_NEAR(at("lidar_reflectance: 1.0"), 3.000, 0.001);
  EXPECT_NEAR(at("lidar_reflectance: 0.25"), 3.015, 0.001);
}

TEST(LidarOptions, LightThatEntersASurfaceReadsLonger) {
  EXPECT_NEAR(
      Forward(World(SceneOf(Planes({{3.0, "penetration_m: 0.008"}})), SmallRig(), WithoutNoise())),
      3.008, 0.001);
}

TEST(LidarOptions, ATranslucentSheetReadsBetweenItselfAndWhatLiesBehind) {
  const auto behind_it = [](double translucency) {
    const std::string sheet = fmt::format("lidar_reflectance: 0.5, translucency: {}", translucency);
    return Forward(World(SceneOf(Planes({{2.0, sheet}, {2.2, "lidar_reflectance: 0.5"}})),
                         SmallRig(), WithoutNoise()));
  };
  EXPECT_NEAR(behind_it(0.0), 2.0, 0.001);
  // Of the light 0.5 comes back from the sheet, 0.25 crosses it twice; power falls with the square
  // of the range.
  const double front = 0.5 / 4.0, back = 0.25 / (2.2 * 2.2);
  EXPECT_NEAR(behind_it(0.5), (2.0 * front + 2.2 * back) / (front + back), 0.001);
}

TEST(LidarOptions, ThroughAClearSheetTheWallFarBehindIsTheStrongestEcho) {
  EXPECT_NEAR(Forward(World(SceneOf(Planes({{2.0, "lidar_reflectance: 0.05, translucency: 0.9"},
                                            {4.0, "lidar_reflectance: 0.9"}})),
                            SmallRig(), WithoutNoise())),
              4.0, 0.001);
}

TEST(LidarOptions, ALeadingEdgePullsWhatMergesToItsNearest) {
  WorldOptions options = WithoutNoise();
  const std::string two = Planes({{2.0, "translucency: 0.5"}, {2.2, "lidar_reflectance: 0.5"}});
  const double mean = Forward(World(SceneOf(two), SmallRig(), options));
  options.lidar.leading_edge = 0.5;
  EXPECT_NEAR(Forward(World(SceneOf(two), SmallRig(), options)), 0.5 * (mean + 2.0), 0.001);
}

/// Quantiles of |error| over those of a normal error of the stated sigma, 50 % and 99 %.
std::pair<double, double> SpreadAndTail(int degrees) {
  WorldOptions options = WithoutNoise();
  options.lidar.sigma_base_m = 0.010;
  options.lidar.tail_degrees = degrees;
  const World world(SceneOf(Planes({{3.0, "lidar_reflectance: 0.5"}})), SmallRig(), options);
  std::vector<double> errors;
  for (int line = 0; line < 60; ++line) {
    const LidarLine measured = world.MeasureLine(line, 0.0, Still);
    for (int beam = kStraightAhead - 30; beam <= kStraightAhead + 30; ++beam) {
      const test::Beam ray = BeamOf(SmallRig(), beam, 0.0);
      errors.push_back(
          std::abs(measured.RawRange(beam) - (3.0 - ray.origin.x()) / ray.direction.x()));
    }
  }
  std::sort(errors.begin(), errors.end());
  return {errors[errors.size() / 2] / 0.0067449, errors[errors.size() * 99 / 100] / 0.0257583};
}

TEST(LidarOptions, StudentsTailsAreAsHeavyAsTheirDegreesSay) {
  // 3660 errors: the 99 % quantile is good to 3 % (normal) and 8 % (three degrees).
  const auto normal = SpreadAndTail(0), heavy = SpreadAndTail(3);
  EXPECT_NEAR(normal.first, 1.0, 0.05);
  EXPECT_NEAR(normal.second, 1.0, 0.1);
  EXPECT_NEAR(heavy.first, 0.7649 / 0.67449, 0.06);
  EXPECT_NEAR(heavy.second, 5.8409 / 2.57583, 0.5);
}

TEST(LidarOptions, AGaussianFootprintLooksLessAtItsRim) {
  // A board covers the left half of the beam's footprint but for its middle strip.
  const std::string scene =
      "materials: {grey: {lidar_reflectance: 0.5}}\n"
      "solids:\n"
      "  - {shape: plane, size_m: [40, 40], position_m: [2.2, 0, 0], rpy_deg: [0, 90, 0], "
      "material: grey}\n"
      "  - {shape: box, size_m: [0.001, 1, 4], position_m: [2.0, 0.5025, 0], material: grey}\n";
  WorldOptions options = WithoutNoise();
  options.lidar.footprint_side = 8;
  options.lidar.footprint_horizontal_rad = 0.010;
  const double even = Forward(World(SceneOf(scene), SmallRig(), options));
  options.lidar.footprint = LidarNoise::Footprint::kGaussian;
  const double gaussian = Forward(World(SceneOf(scene), SmallRig(), options));
  EXPECT_LT(even, 2.17);
  EXPECT_GT(gaussian, even + 0.01);
}

TEST(LidarOptions, NameTheMemberAtFault) {
  WorldOptions options;
  options.lidar.tail_degrees = -1;
  const Status status = options.Check();
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().message, "lidar tail_degrees -1 is not between 0 and 100");
}

}  // namespace
}  // namespace foresight
