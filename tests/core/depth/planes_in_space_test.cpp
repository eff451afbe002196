// What planes over rays, and a start from the samples' own planes, are for.
#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/depth/local_plane.h"
#include "tests/support/sample_grids.h"
#include "tests/support/small_camera.h"

namespace foresight {
namespace {

/// A slanted wall: inverse depth 0.5 + 0.08 X/Z - 0.06 Y/Z, per metre.
double WallAt(const CameraModel& camera, int u, int v) {
  const Eigen::Vector2d ray = *camera.UnprojectToPlane({u, v});
  return 1.0 / (0.5 + 0.08 * ray.x() - 0.06 * ray.y());
}

/// Samples with their exact rays.
AlignedSamples SeenBy(const CameraModel& camera) {
  AlignedSamples samples = SamplesOnLattice(camera.width, camera.height, 4, 12,
                                            [&](int u, int v) { return WallAt(camera, u, v); });
  for (AlignedSample& s : samples.samples) {
    const Eigen::Vector2d ray = *camera.UnprojectToPlane({s.u, s.v});
    s.point = (s.depth_m * ray.homogeneous()).cast<float>();
  }
  samples.rays = RaysOf(camera);
  return samples;
}

using Truth = std::function<double(int, int)>;

/// Errors of all pixels farther than `border` px from the rows and columns of the image's edge:
/// with samples on one side only, the ridge on the slopes costs millimetres.
double LargestError(const AlignedSamples& samples, int border, const Truth& truth) {
  const ColorImage guide(samples.width, samples.height, {128, 128, 128});
  const auto dense = UpsampleLocalPlanes(samples, guide, {}, {});
  double worst = 0.0;
  for (int v = border; v < samples.height - border; ++v)
    for (int u = border; u < samples.width - border; ++u) {
      const double error = std::abs(dense->depth_m(u, v) - truth(u, v));
      worst = error <= worst ? worst : error;  // a NaN stays the worst
    }
  return worst;
}

TEST(PlanesInSpace, AreExactThroughTheFisheyeLens) {
  const CameraModel camera = SmallCameraRig().camera;
  AlignedSamples samples = SeenBy(camera);
  const auto truth = [&](int u, int v) { return WallAt(camera, u, v); };
  const double over_rays = LargestError(samples, 36, truth);
  samples.rays = nullptr;
  const double over_pixels = LargestError(samples, 36, truth);
  EXPECT_LT(over_rays, 0.001);
  EXPECT_GT(over_pixels, 0.004);
}

/// A floor at a grazing angle: where the test looks, neighbouring lines are 120 to 280 mm apart,
/// five to thirteen sigma_d.
double Floor(int, int v) {
  return 1.0 / (0.2 + 0.008 * v);
}

TEST(PlanesInSpace, AreFollowedAtAGrazingAngle) {
  const AlignedSamples samples = SamplesOnLattice(160, 160, 4, 12, Floor);
  EXPECT_LT(LargestError(samples, 48, Floor), 0.002);
}

TEST(PlanesInSpace, AreTrustedAtAGrazingAngle) {
  const AlignedSamples samples = SamplesOnLattice(160, 160, 4, 12, Floor);
  const auto dense = UpsampleLocalPlanes(samples, ColorImage(160, 160, {128, 128, 128}), {}, {});
  for (int v = 48; v < 112; ++v) ASSERT_GT(dense->confidence(80, v), 0.9f) << v;
}

TEST(PlanesInSpace, AreFollowedAtAGrazingAngleThroughNoise) {
  Random random(3);
  const AlignedSamples samples = SamplesOnLattice(
      160, 160, 4, 12, [&](int u, int v) { return Floor(u, v) + 0.010 * random.Normal(); });
  // Three sigma of one measurement: a plane of the wrong lines is off by a line's step.
  EXPECT_LT(LargestError(samples, 48, Floor), 0.030);
}

}  // namespace
}  // namespace foresight
