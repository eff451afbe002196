#include "core/depth/ray_field.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/sensor/sensor_rig.h"
#include "tests/support/sample_grids.h"

namespace foresight {
namespace {

TEST(RaysOfACamera, AreWhereItsPixelsLook) {
  const CameraModel camera = DefaultSensorRig().camera;
  const auto rays = RaysOf(camera);
  ASSERT_EQ(rays->x.width(), camera.width);
  ASSERT_EQ(rays->x.height(), camera.height);
  ASSERT_TRUE(rays->x.SameSize(rays->y));
  for (int v = 0; v < camera.height; v += 37)
    for (int u = 0; u < camera.width; u += 41) {
      const auto ray = camera.UnprojectToPlane({u, v});
      ASSERT_TRUE(ray);
      ASSERT_FLOAT_EQ(rays->x(u, v), static_cast<float>(ray->x()));
      ASSERT_FLOAT_EQ(rays->y(u, v), static_cast<float>(ray->y()));
    }
}

TEST(RaysOfACamera, AreNaNAtRightAnglesAndBeyond) {
  CameraModel camera = PinholeCamera(401, 21, 100.0, 200.0, 10.0);
  camera.lens = FisheyeLens{1.0};  // u - cx = 100 px times the angle: pi / 2 is 157 px away
  const auto rays = RaysOf(camera);
  EXPECT_TRUE(std::isfinite(rays->x(200 + 157, 10)));
  EXPECT_TRUE(std::isnan(rays->x(200 + 158, 10)));
  EXPECT_TRUE(std::isnan(rays->y(200 + 158, 10)));
  EXPECT_TRUE(std::isnan(rays->x(0, 0)));
}

TEST(RaysOfACamera, AreSharedByThoseWhoAskForTheSameCamera) {
  CameraModel camera = PinholeCamera(32, 24, 50.0, 16.0, 12.0);
  const auto first = RaysOf(camera);
  EXPECT_EQ(RaysOf(camera), first);
  camera.fx = 51.0;
  EXPECT_NE(RaysOf(camera), first);
}

TEST(RaysOfACamera, StayAsLongAsSomeoneHoldsThem) {
  const auto held = RaysOf(PinholeCamera(32, 24, 60.0, 16.0, 12.0));
  const FloatImage before = held->x;
  for (int i = 1; i <= 10; ++i) RaysOf(PinholeCamera(32, 24, 60.0 + i, 16.0, 12.0));
  EXPECT_EQ(held->x, before);
  EXPECT_EQ(RaysOf(PinholeCamera(32, 24, 60.0, 16.0, 12.0))->x, before);
}

TEST(AlignedSamples, RefuseRaysOfAnotherSize) {
  AlignedSamples samples = SamplesOnLattice(80, 60, 4, 12, [](int, int) { return 1.5; });
  samples.rays = RaysOf(PinholeCamera(80, 60, 500.0, 40.0, 30.0));
  EXPECT_TRUE(samples.Check());
  samples.rays = RaysOf(PinholeCamera(80, 61, 500.0, 40.0, 30.0));
  const Status status = samples.Check();
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::kInvalidInput);
  EXPECT_NE(status.error().message.find("80 x 61"), std::string::npos) << status.error().message;
}

}  // namespace
}  // namespace foresight
