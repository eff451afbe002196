#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/geometry/angles.h"
#include "tests/core/simulation/small_world.h"

namespace foresight {
namespace {

using test::BeamOf;
using test::Noiseless;
using test::SceneOf;
using test::SmallRig;
using test::Still;

constexpr int kForward = 540;  ///< the beam at 0 deg

std::string Wall(double x_m, double reflectance = 0.5) {
  return fmt::format(
      "materials: {{grey: {{lidar_reflectance: {}}}}}\n"
      "solids:\n"
      "  - {{shape: plane, size_m: [40, 40], position_m: [{}, 0, 0], rpy_deg: [0, 90, 0], "
      "material: "
      "grey}}\n",
      reflectance, x_m);
}

/// A board to the left of the beam at 0 deg, before a wall.
std::string BoardBeforeWall(double board_x_m, double wall_x_m) {
  return Wall(wall_x_m) +
         fmt::format(
             "  - {{shape: box, size_m: [0.001, 2, 4], position_m: [{}, 1, 0], material: "
             "grey}}\n",
             board_x_m);
}

double WallRange(const test::Beam& beam, double wall_x_m) {
  return (wall_x_m - beam.origin.x()) / beam.direction.x();
}

/// Only what the test switches on again.
WorldOptions OnlyFootprint() {
  WorldOptions options = Noiseless();
  options.lidar = {.sigma_base_m = 0.0,
                   .sigma_per_metre = 0.0,
                   .sigma_at_threshold_m = 0.0,
                   .walk_at_threshold_m = 0.0,
                   .spurious_fraction = 0.0,
                   .enabled = true};
  return options;
}

TEST(SimulatedLidar, ReportsTheExactRangeToAWallWithinItsMillimetre) {
  const World world(SceneOf(Wall(3.0)), SmallRig(), Noiseless());
  const LidarLine line = world.MeasureLine(0, 0.0, Still);
  ASSERT_EQ(line.range_mm.size(), 1081u);
  for (int beam = kForward - 200; beam <= kForward + 200; ++beam)
    ASSERT_NEAR(line.RawRange(beam), WallRange(BeamOf(SmallRig(), beam, 0.0), 3.0), 0.00051)
        << beam;
}

TEST(SimulatedLidar, TakesEachBeamAtItsOwnTime) {
  const World world(SceneOf(Wall(3.0)), SmallRig(), Noiseless());
  const double speed_rad_s = RadiansFromDegrees(120.0);
  const auto motor_rad_at = [&](double time_s) { return 0.3 + speed_rad_s * (time_s - 5.0); };
  const LidarLine line = world.MeasureLine(0, 5.0, motor_rad_at);
  for (int beam = kForward - 200; beam <= kForward + 200; ++beam) {
    const double plate_rad = motor_rad_at(5.0 + SmallRig().lidar.BeamTime(beam));
    ASSERT_NEAR(line.RawRange(beam), WallRange(BeamOf(SmallRig(), beam, plate_rad), 3.0), 0.00051)
        << beam;
  }
}

TEST(SimulatedLidar, LeavesOutTheOffsetThatACalibrationAdds) {
  SensorRig rig = SmallRig();
  rig.lidar.range_offset_m = 0.025;
  const World world(SceneOf(Wall(3.0)), rig, Noiseless());
  const double expected = WallRange(BeamOf(rig, kForward, 0.0), 3.0) - 0.025;
  EXPECT_NEAR(world.MeasureLine(0, 0.0, Still).RawRange(kForward), expected, 0.00051);
}

TEST(SimulatedLidar, SpreadsItsRangesByTheStatedSigma) {
  WorldOptions options = Noiseless();
  options.lidar = {.spurious_fraction = 0.0, .enabled = true};
  const World world(SceneOf(Wall(4.0)), SmallRig(), options);
  constexpr int kLines = 60;
  constexpr int kBeams = 40;
  std::vector<double> sum(kBeams, 0.0);
  std::vector<double> squares(kBeams, 0.0);
  for (int i = 0; i < kLines; ++i) {
    const LidarLine line = world.MeasureLine(i, 0.0, Still);
    for (std::size_t b = 0; b < kBeams; ++b) {
      const double range = line.RawRange(kForward - 20 + static_cast<int>(b)) - 4.0;
      sum[b] += range;
      squares[b] += range * range;
    }
  }
  double variance = 0.0;
  for (std::size_t b = 0; b < kBeams; ++b)
    variance += (squares[b] - sum[b] * sum[b] / kLines) / (kLines - 1) / kBeams;
  // 4 mm + 0.8 mm/m over the 3.96 m from the lidar. 2400 samples give sigma to 1.5 %, the
  // weak-signal term and the quantisation add 1 %.
  const double stated = 0.004 + 0.0008 * WallRange(BeamOf(SmallRig(), kForward, 0.0), 4.0);
  EXPECT_NEAR(std::sqrt(variance), stated, 0.06 * stated);
}

TEST(SimulatedLidar, MixesRangesOnlyAtTheEdgeBetweenTwoCloseSurfaces) {
  const World world(SceneOf(BoardBeforeWall(2.0, 2.3)), SmallRig(), OnlyFootprint());
  const LidarLine line = world.MeasureLine(0, 0.0, Still);
  int mixed = 0;
  for (int beam = kForward - 150; beam <= kForward + 150; ++beam) {
    const test::Beam ray = BeamOf(SmallRig(), beam, 0.0);
    const double depth = ray.origin.x() + line.RawRange(beam) * ray.direction.x();
    if (std::abs(depth - 2.0) < 0.02 || std::abs(depth - 2.3) < 0.02) continue;
    ++mixed;
    // Half a footprint of 5 mrad is 0.57 beams.
    EXPECT_LE(std::abs(beam - kForward), 1) << depth;
  }
  EXPECT_GE(mixed, 1);
}

TEST(SimulatedLidar, NeverMixesSurfacesFartherApartThanItsPulse) {
  const World world(SceneOf(BoardBeforeWall(2.0, 2.7)), SmallRig(), OnlyFootprint());
  const LidarLine line = world.MeasureLine(0, 0.0, Still);
  for (int beam = kForward - 150; beam <= kForward + 150; ++beam) {
    const test::Beam ray = BeamOf(SmallRig(), beam, 0.0);
    const double depth = ray.origin.x() + line.RawRange(beam) * ray.direction.x();
    EXPECT_LT(std::min(std::abs(depth - 2.0), std::abs(depth - 2.7)), 0.02) << beam;
  }
}

TEST(SimulatedLidar, LosesADarkFarSurface) {
  // 0.02 / 8^2 = 0.0003 is below the 0.001 it needs.
  const World world(SceneOf(Wall(8.0, 0.02)), SmallRig(), OnlyFootprint());
  const LidarLine line = world.MeasureLine(0, 0.0, Still);
  EXPECT_EQ(line.range_mm[kForward], 1);
  EXPECT_EQ(line.intensity[kForward], 0);
}

TEST(SimulatedLidar, KeepsAWhiteSurfaceWhereADarkOneIsLost) {
  const World world(SceneOf(Wall(8.0, 0.9)), SmallRig(), OnlyFootprint());
  const LidarLine line = world.MeasureLine(0, 0.0, Still);
  EXPECT_NEAR(line.RawRange(kForward), 8.0, 0.06);  // the lidar sits 55 mm before the axis
  EXPECT_GT(line.intensity[kForward], 0);
}

TEST(SimulatedLidar, LosesAMirrorThatItIntersectsAslant) {
  const std::string scene =
      "materials: {mirror: {lidar_reflectance: 0.5, specular: 1.0}}\n"
      "solids:\n"
      "  - {shape: plane, size_m: [40, 40], position_m: [3, 0, 0], rpy_deg: [0, 90, 0], material: "
      "mirror}\n";
  const World world(SceneOf(scene), SmallRig(), OnlyFootprint());
  const LidarLine line = world.MeasureLine(0, 0.0, Still);
  EXPECT_GT(line.range_mm[kForward], 2900);
  EXPECT_EQ(line.range_mm[kForward + 120], 1);  // 30 deg off its normal
}

TEST(SimulatedLidar, ReportsNoEchoWhereThereIsNothing) {
  const World world(SceneOf(Wall(3.0)), SmallRig(), OnlyFootprint());
  EXPECT_EQ(world.MeasureLine(0, 0.0, Still).range_mm[0], 1);  // 135 deg to the right
}

TEST(SimulatedLidar, ThrowsInSpuriousReturnsAtTheStatedFraction) {
  WorldOptions options = OnlyFootprint();
  options.lidar.spurious_fraction = 0.2;
  const World world(SceneOf(Wall(3.0)), SmallRig(), options);
  int spurious = 0;
  int beams = 0;
  for (int i = 0; i < 10; ++i) {
    const LidarLine line = world.MeasureLine(i, 0.0, Still);
    for (int beam = kForward - 200; beam <= kForward + 200; ++beam, ++beams)
      if (std::abs(line.RawRange(beam) - WallRange(BeamOf(SmallRig(), beam, 0.0), 3.0)) > 0.05)
        ++spurious;
  }
  // 4010 beams: one sigma is 0.006.
  EXPECT_NEAR(static_cast<double>(spurious) / beams, 0.2, 0.025);
}

TEST(SimulatedLidar, GivesTheSameLineWhateverWasAskedBefore) {
  const World asked_in_order(SceneOf(Wall(3.0)), SmallRig(), {});
  const World asked_once(SceneOf(Wall(3.0)), SmallRig(), {});
  for (int i = 0; i < 5; ++i) asked_in_order.MeasureLine(i, 0.0, Still);
  EXPECT_EQ(asked_in_order.MeasureLine(7, 0.0, Still), asked_once.MeasureLine(7, 0.0, Still));
}

TEST(SimulatedLidar, LinesDifferInTheirNoise) {
  const World world(SceneOf(Wall(3.0)), SmallRig(), {});
  EXPECT_NE(world.MeasureLine(1, 0.0, Still).range_mm, world.MeasureLine(2, 0.0, Still).range_mm);
}

TEST(SimulatedLidar, SeedsDifferInTheirNoise) {
  const World one(SceneOf(Wall(3.0)), SmallRig(),
                  {.seed = 1, .lidar = {}, .camera = {}, .motor = {}});
  const World two(SceneOf(Wall(3.0)), SmallRig(),
                  {.seed = 2, .lidar = {}, .camera = {}, .motor = {}});
  EXPECT_NE(one.MeasureLine(1, 0.0, Still).range_mm, two.MeasureLine(1, 0.0, Still).range_mm);
}

TEST(WorldOptions, NameTheMemberAtFault) {
  WorldOptions options;
  options.lidar.footprint_side = 0;
  const Status status = options.Check();
  ASSERT_FALSE(status.has_value());
  EXPECT_EQ(status.error().message, "lidar footprint_side 0 is not between 1 and 16");
}

}  // namespace
}  // namespace foresight
