#include <gtest/gtest.h>

#include "core/sensor/sensor_rig.h"
#include "core/simulation/pixel_rays.h"

namespace foresight {
namespace {

TEST(PixelRays, AreThoseOfTheCamera) {
  const CameraModel camera = DefaultSensorRig().camera;
  const PixelRays rays(camera);
  for (double y = -0.5; y < camera.height; y += 10.7)
    for (double x = -0.5; x < camera.width; x += 7.3) {
      const auto exact = camera.Unproject({x, y});
      const auto fast = rays.At({x, y});
      ASSERT_TRUE(exact && fast);
      // A ray is used as floats, whose steps are 6e-8.
      ASSERT_LT((*exact - *fast).norm(), 1e-12) << x << ", " << y;
    }
}

TEST(PixelRays, OfAnotherLensAreThoseOfTheCameraToo) {
  CameraModel camera = DefaultSensorRig().camera;
  camera.lens = KannalaBrandtLens{};
  EXPECT_EQ(*PixelRays(camera).At({100.0, 50.0}), *camera.Unproject({100.0, 50.0}));
}

TEST(PixelRays, BesideTheImageAreThoseOfTheCameraToo) {
  const CameraModel camera = DefaultSensorRig().camera;
  const PixelRays rays(camera);
  const auto beside = rays.At({-20.0, -9.0}), exact = camera.Unproject({-20.0, -9.0});
  ASSERT_TRUE(beside && exact);
  EXPECT_EQ(*beside, *exact);
  ASSERT_FALSE(camera.Unproject({-20000.0, -9000.0})) << "no ray falls there";
  EXPECT_FALSE(rays.At({-20000.0, -9000.0}));
}

}  // namespace
}  // namespace foresight
