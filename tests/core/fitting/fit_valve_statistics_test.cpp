#include <gtest/gtest.h>

#include <cstdio>

#include "core/depth/pipeline.h"
#include "core/detection/fit_in_scan.h"
#include "core/geometry/angles.h"
#include "core/registration/register_scan.h"
#include "core/simulation/world.h"
#include "tests/support/valve_rays.h"
#include "tests/support/valve_scan.h"

namespace foresight {
namespace {

using samples::CompareValves;
using samples::ValveError;

constexpr double kSigma_m = 0.010;

bool PoseRight(const ValveError& error) {
  return error.center_m < 0.020 && DegreesFromRadians(error.axis_rad) < 5.0 &&
         error.radius_m < 0.012;
}

TEST(FitValveStatistics, WheelsOfAllKindsAreFound) {
  int pose_right = 0;
  int spokes_right = 0;
  int confirmed = 0;
  int confirmed_wrongly = 0;
  constexpr int kViews = 60;
  for (std::uint64_t seed = 1; seed <= kViews; ++seed) {
    const samples::ValveScene scene = MakeValveScene(samples::RandomValveView(seed));
    const auto found = FitValve(scene.rays, {}, {});
    if (!found) continue;
    const ValveError error = CompareValves(found->best, scene.truth);
    pose_right += PoseRight(error) ? 1 : 0;
    spokes_right += error.spokes_right ? 1 : 0;
    if (found->verdict.level != VerdictLevel::kConfirmed) continue;
    ++confirmed;
    confirmed_wrongly += PoseRight(error) && error.spokes_right ? 0 : 1;
  }
  std::printf("pose %d, spokes %d, confirmed %d (wrongly %d) of %d\n", pose_right, spokes_right,
              confirmed, confirmed_wrongly, kViews);
  EXPECT_GE(pose_right, 56);  // 0.93
  EXPECT_GE(confirmed, 1);
  EXPECT_GE(spokes_right, 57);  // 0.95
  EXPECT_EQ(confirmed_wrongly, 0);
}

/// A wall, a box and a ball in the views of these seeds, 1 to `views`.
void ExpectOtherThingsUnconfirmed(std::uint64_t views) {
  using Object = samples::ValveView::Object;
  for (const Object object : {Object::kNothing, Object::kBox, Object::kBall}) {
    int answers = 0;
    for (std::uint64_t seed = 1; seed <= views; ++seed) {
      samples::ValveView view = samples::RandomValveView(seed);
      view.object = object;
      const auto found = FitValve(MakeValveScene(view).rays, {}, {});
      if (!found) continue;
      ++answers;
      EXPECT_NE(found->verdict.level, VerdictLevel::kConfirmed)
          << "object " << static_cast<int>(object) << ", seed " << seed;
    }
    std::printf("object %d: %d answers of %d\n", static_cast<int>(object), answers,
                static_cast<int>(views));
    // A wall with a pipe or none: nothing may stand before it. A box and a ball always do.
    const int least = static_cast<int>(object == Object::kNothing ? views / 2 : views);
    EXPECT_GE(answers, least) << static_cast<int>(object);
  }
}

TEST(FitValveStatistics, OtherThingsAreNotConfirmedInThreeViews) {
  ExpectOtherThingsUnconfirmed(3);
}

TEST(FitValveStatistics, OtherThingsAreNotConfirmedInTenViews) {
  ExpectOtherThingsUnconfirmed(10);
}

/// The valve scene of the repository, swept at 10 deg/s, with the wheel in a region around it.
class SimulatedValve : public ::testing::Test {
 protected:
  void SetUp() override {
    auto scene = LoadScene(FORESIGHT_SOURCE_DIR "/resources/scenes/valve.yaml");
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_FALSE(scene->valves.empty());
    scene_ = std::make_shared<const Scene>(std::move(*scene));
  }

  struct Seen {
    Scan scan;
    RegisteredScan cloud;
    ImageRoi roi;
    ValveCandidate truth;
  };

  Seen Look(std::uint64_t seed) const {
    WorldOptions options;
    options.seed = seed;
    const World world(scene_, DefaultSensorRig(), options);
    Seen seen;
    seen.scan = samples::SweepWorld(world, RadiansFromDegrees(-20), RadiansFromDegrees(20),
                                    RadiansFromDegrees(10), 0.0);
    auto cloud = RegisterScan(seen.scan, {});
    EXPECT_TRUE(cloud);
    seen.cloud = std::move(*cloud);
    const ValveTruth& truth = scene_->valves.front();
    seen.truth = {world.BaseFromRobot() * truth.robot_from_object, truth.model, 0.0};
    const double motor_rad = seen.scan.frames.front().motor_angle_rad;
    const Eigen::Vector3d center =
        seen.scan.rig.CameraFromBase(motor_rad) * seen.truth.base_from_object.translation();
    const auto pixel = seen.scan.rig.camera.Project(center);
    EXPECT_TRUE(pixel);
    // As an operator draws it: a third more than the rim, not quite centred.
    const double half_px = 1.35 * truth.model.rim_radius_m / center.z() * seen.scan.rig.camera.fx;
    Random random(seed, 3);
    const Eigen::Vector2d off(random.Uniform(-12.0, 12.0), random.Uniform(-12.0, 12.0));
    const Eigen::Vector2d half(half_px, half_px);
    seen.roi = ImageRoi::Rectangle(motor_rad, *pixel + off - half, *pixel + off + half);
    return seen;
  }

  /// Whether a fit is as good as a gripper needs it; prints a row of the table.
  static bool GoodEnough(std::uint64_t seed, const Result<ValveDetection>& found,
                         const ValveCandidate& truth) {
    if (!found) {
      std::printf("%2d %s\n", static_cast<int>(seed), found.error().message.c_str());
      return false;
    }
    const ValveError error = CompareValves(found->best, truth);
    std::printf(
        "%2d N %d centre %4.1f mm axis %4.2f deg R %4.1f mm phase %4.1f deg %s %.3f %.2f s\n",
        static_cast<int>(seed), found->best.model.spokes, 1000.0 * error.center_m,
        DegreesFromRadians(error.axis_rad), 1000.0 * error.radius_m,
        DegreesFromRadians(error.phase_rad), ToString(found->verdict.level),
        found->verdict.probability, found->origin.seconds);
    return error.spokes_right && error.center_m < 0.010 && DegreesFromRadians(error.axis_rad) < 3.0;
  }

  std::shared_ptr<const Scene> scene_;
};

TEST_F(SimulatedValve, IsFoundInTheRawReturns) {
  int good = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Seen seen = Look(seed);
    const auto rays = RaysFromScan(seen.cloud, seen.scan.rig, seen.roi, kSigma_m);
    ASSERT_TRUE(rays) << rays.error().message;
    good += GoodEnough(seed, FitValve(*rays, {}, {}), seen.truth) ? 1 : 0;
  }
  EXPECT_GE(good, 18);
}

Result<ValveDetection> FitDense(const Scan& scan, const RegisteredScan& cloud, const ImageRoi& roi,
                                const DepthOptions& options) {
  FORESIGHT_TRY(AlignedSamples samples, AlignToImage(cloud, scan.rig, roi.motor_rad, {}));
  FORESIGHT_TRY(const DepthResult depth,
                ComputeDepth(std::move(samples), scan.frames.front().image, options, {}));
  return FitValveInScan({scan.rig, cloud, {}, &depth}, FitSource::kDepth, roi, {}, {});
}

TEST_F(SimulatedValve, IsFoundInTheDenseDepthOfAFilterThatSparesThinThings) {
  DepthOptions options;
  options.flying.rule = FlyingPointOptions::Rule::kBothNeighboursFar;
  options.upsample.sigma_spatial_px = 6.0;
  int good = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Seen seen = Look(seed);
    good += GoodEnough(seed, FitDense(seen.scan, seen.cloud, seen.roi, options), seen.truth);
  }
  EXPECT_GE(good, 18);
}

TEST_F(SimulatedValve, WhatIsConfirmedInThePapersOwnDepthIsRight) {
  // A known limit: Eq. (7) as printed takes a 24 mm tube for flying points, and little of the wheel
  // stays in the depth map. The verdict must know which of the fits to believe.
  int answers = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Seen seen = Look(seed);
    const auto found = FitDense(seen.scan, seen.cloud, seen.roi, DepthOptions());
    const bool good = GoodEnough(seed, found, seen.truth);
    const bool confirmed = found && found->verdict.level == VerdictLevel::kConfirmed;
    EXPECT_TRUE(good || !confirmed) << "seed " << seed;
    answers += found ? 1 : 0;
  }
  EXPECT_EQ(answers, 4);
}

}  // namespace
}  // namespace foresight
