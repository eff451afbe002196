#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/quantile.h"
#include "core/geometry/angles.h"
#include "core/registration/register_scan.h"
#include "tests/core/simulation/small_world.h"

namespace foresight {
namespace {

constexpr double kSpeed_rad_s = 0.17453292519943295;  // 10 deg/s

/// A sweep over the valve as the devices would bring it home, with the rig of a perfect
/// calibration.
Scan SweepOverValve(const World& world) {
  const auto motor_rad_at = [](double time_s) {
    return RadiansFromDegrees(-8.0) + kSpeed_rad_s * time_s;
  };
  Scan scan;
  scan.rig = world.true_rig();
  scan.rig.angle_correction = world.CalibratedCorrection();
  for (int i = 0; i <= 350; ++i)
    scan.track.Add({0.004 * i, world.EncoderAngle(motor_rad_at(0.004 * i))});
  for (int i = 2; i < 52; ++i) scan.lines.push_back(world.MeasureLine(i, 0.025 * i, motor_rad_at));
  return scan;
}

/// Distances to the model of all points within the wheel's disc and a thumb's breadth before or
/// behind it.
std::vector<double> DistancesToWheel(const World& world, const RegisteredScan& scan) {
  const ValveTruth& valve = world.scene().valves.front();
  const auto object_from_base = valve.robot_from_object.Inverse() * world.BaseFromRobot().Inverse();
  std::vector<double> distances;
  for (const Eigen::Vector3f& point : scan.points) {
    const Eigen::Vector3d p = object_from_base * point.cast<double>();
    if (std::hypot(p.x(), p.y()) < 0.17 && std::abs(p.z()) < 0.02)
      distances.push_back(std::abs(valve.model.Distance(p)));
  }
  return distances;
}

TEST(ScanOfTheValve, LandsOnTheModelThatIsItsTruth) {
  auto scene = LoadScene(FORESIGHT_SOURCE_DIR "/resources/scenes/valve.yaml");
  ASSERT_TRUE(scene.has_value()) << scene.error().message;
  WorldOptions options;
  options.lidar.enabled = false;
  const World world(std::make_shared<const Scene>(std::move(*scene)), DefaultSensorRig(), options);
  const auto registered = RegisterScan(SweepOverValve(world), {});
  ASSERT_TRUE(registered.has_value()) << registered.error().message;
  std::vector<double> distances = DistancesToWheel(world, *registered);
  ASSERT_GT(distances.size(), 300u);
  // The quantisation gives 0.5 mm. Up to 0.045 deg of plate angle, 1 mm, are unknown to the
  // calibration, but act along the surface for most points; without it the result is 1.6 mm.
  EXPECT_LT(Quantile(std::move(distances), 0.95), 0.001);
}

}  // namespace
}  // namespace foresight
