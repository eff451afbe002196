#include "core/sensor/camera_model.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/geometry/angles.h"

namespace foresight {
namespace {

constexpr double kPaper = 0.9413;

CameraModel PaperCamera() {
  return {.width = 1288,
          .height = 964,
          .fx = 601.0,
          .fy = 601.0,
          .cx = 643.5,
          .cy = 481.5,
          .lens = FisheyeLens{kPaper}};
}

TEST(FisheyeLens, SeesThePapersFieldOfViewWithSquarePixels) {
  // 118.6 x 90.0 deg on 1288 x 964 with k = 0.9413 gives fx = 601.36 and fy = 600.80: square to 0.1
  // %.
  const double k = 0.9413;
  const auto focal = [&](double half_size_px, double field_deg) {
    return half_size_px / (std::atan(k * std::tan(RadiansFromDegrees(field_deg / 2))) / k);
  };
  const double fx = focal(644.0, 118.6);
  const double fy = focal(482.0, 90.0);
  EXPECT_NEAR(fx, 601.36, 0.02);
  EXPECT_NEAR(fx / fy, 1.0009, 0.0002);
  CameraModel camera = PaperCamera();
  camera.fx = fx;
  const auto edge = camera.Unproject({643.5 + 644.0, 481.5});
  EXPECT_NEAR(DegreesFromRadians(std::atan2(edge->x(), edge->z())), 59.3, 0.001);
}

TEST(FisheyeLens, IsTheFieldOfViewModelOfDevernayAndFaugeras) {
  // With k = 2 tan(w / 2) and f_FOV = f w / k: u - cx = f_FOV atan(2 r tan(w / 2)) / w.
  const CameraModel camera = PaperCamera();
  const double w = 2.0 * std::atan(kPaper / 2.0);
  const double focal_fov = camera.fx * w / kPaper;
  for (const double r : {0.01, 0.3, 1.0, 1.6}) {
    const double fov = focal_fov * std::atan(2.0 * r * std::tan(w / 2.0)) / w;
    const auto pixel = camera.Project({r, 0.0, 1.0});
    EXPECT_NEAR(pixel->x() - camera.cx, fov, 1e-9);
  }
}

TEST(FisheyeLens, TheDerivativeByKIsExactNearTheAxis) {
  // The closed form cancels here; the leading term of the series is -2/3 k rho^3.
  const CameraModel camera = PaperCamera();
  CameraModel::ByParameters by_parameters;
  const double rho = 1e-4;
  ASSERT_TRUE(camera.Project({rho, 0.0, 1.0}, nullptr, &by_parameters));
  const double expected = -2.0 / 3.0 * kPaper * rho * rho * rho * camera.fx;
  EXPECT_NEAR(by_parameters(0, 4) / expected, 1.0, 1e-7);
}

TEST(FisheyeLens, WithKZeroIsAPinhole) {
  const CameraModel camera = PinholeCamera(640, 480, 500.0, 320.0, 240.0);
  const auto pixel = camera.Project({0.5, -0.25, 2.0});
  EXPECT_NEAR(pixel->x(), 320.0 + 500.0 * 0.25, 1e-12);
  EXPECT_NEAR(pixel->y(), 240.0 - 500.0 * 0.125, 1e-12);
  EXPECT_FALSE(camera.Project({0.1, 0.1, -1.0}));
}

TEST(FisheyeLens, RefusesWhatHasNoPixel) {
  const CameraModel camera = PaperCamera();
  EXPECT_FALSE(camera.Project({0.0, 0.0, -1.0}));
  EXPECT_FALSE(camera.Project({std::nan(""), 0.0, 1.0}));
  EXPECT_FALSE(camera.Unproject({643.5 + 601.0 * 3.4, 481.5}));
  EXPECT_FALSE(camera.UnprojectToPlane({643.5 + 601.0 * 1.7, 481.5}));
}

}  // namespace
}  // namespace foresight
