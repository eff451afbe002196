#include "core/sensor/fisheye_camera.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

FisheyeCamera PaperCamera() {
  return {.width = 1288,
          .height = 964,
          .fx = 601.0,
          .fy = 601.0,
          .cx = 643.5,
          .cy = 481.5,
          .k = 0.9413};
}

TEST(FisheyeCamera, ProjectsWhatItUnprojects) {
  const FisheyeCamera camera = PaperCamera();
  Random random(1);
  for (int i = 0; i < 10000; ++i) {
    const Eigen::Vector2d pixel(random.Uniform(0, 1288), random.Uniform(0, 964));
    const auto back = camera.Project(2.5 * camera.Unproject(pixel).value());
    // The bar of the round trip: 1e-9 px.
    ASSERT_LT((back.value() - pixel).norm(), 1e-9);
  }
}

TEST(FisheyeCamera, SeesThePapersFieldOfViewWithSquarePixels) {
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
  FisheyeCamera camera = PaperCamera();
  camera.fx = fx;
  const auto edge = camera.Unproject({643.5 + 644.0, 481.5});
  EXPECT_NEAR(DegreesFromRadians(std::atan2(edge->x(), edge->z())), 59.3, 0.001);
}

TEST(FisheyeCamera, IsTheFieldOfViewModelOfDevernayAndFaugeras) {
  // With k = 2 tan(w / 2) and f_FOV = f w / k: u - cx = f_FOV atan(2 r tan(w / 2)) / w.
  const FisheyeCamera camera = PaperCamera();
  const double w = 2.0 * std::atan(camera.k / 2.0);
  const double focal_fov = camera.fx * w / camera.k;
  for (const double r : {0.01, 0.3, 1.0, 1.6}) {
    const double fov = focal_fov * std::atan(2.0 * r * std::tan(w / 2.0)) / w;
    const auto pixel = camera.Project({r, 0.0, 1.0});
    EXPECT_NEAR(pixel->x() - camera.cx, fov, 1e-9);
  }
}

TEST(FisheyeCamera, DerivativesAgreeWithDifferences) {
  const FisheyeCamera camera = PaperCamera();
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    // In front, beside and behind; near the axis too.
    const double spread = i % 4 == 0 ? 0.004 : 1.5;
    const Eigen::Vector3d point(random.Uniform(-spread, spread), random.Uniform(-spread, spread),
                                i % 5 == 4 ? -0.2 : random.Uniform(0.3, 3.0));
    Eigen::Matrix<double, 2, 3> by_point;
    Eigen::Matrix<double, 2, 5> by_parameters;
    ASSERT_TRUE(camera.Project(point, &by_point, &by_parameters));
    const double step = 1e-6;
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d shift = step * Eigen::Vector3d::Unit(axis);
      const Eigen::Vector2d numeric =
          (*camera.Project(point + shift) - *camera.Project(point - shift)) / (2 * step);
      EXPECT_LT((by_point.col(axis) - numeric).norm(), 1e-6 * (1.0 + numeric.norm()) + 1e-4)
          << point.transpose();
    }
    FisheyeCamera more = camera, less = camera;
    more.k += step;
    less.k -= step;
    const Eigen::Vector2d numeric = (*more.Project(point) - *less.Project(point)) / (2 * step);
    EXPECT_LT((by_parameters.col(4) - numeric).norm(), 1e-4 + 1e-6 * numeric.norm());
  }
}

TEST(FisheyeCamera, TheDerivativeByKIsExactNearTheAxis) {
  // The closed form cancels here; the leading term of the series is -2/3 k rho^3.
  const FisheyeCamera camera = PaperCamera();
  Eigen::Matrix<double, 2, 5> by_parameters;
  const double rho = 1e-4;
  ASSERT_TRUE(camera.Project({rho, 0.0, 1.0}, nullptr, &by_parameters));
  const double expected = -2.0 / 3.0 * camera.k * rho * rho * rho * camera.fx;
  EXPECT_NEAR(by_parameters(0, 4) / expected, 1.0, 1e-7);
}

TEST(FisheyeCamera, WithKZeroIsAPinhole) {
  const FisheyeCamera camera = PinholeCamera(640, 480, 500.0, 320.0, 240.0);
  const auto pixel = camera.Project({0.5, -0.25, 2.0});
  EXPECT_NEAR(pixel->x(), 320.0 + 500.0 * 0.25, 1e-12);
  EXPECT_NEAR(pixel->y(), 240.0 - 500.0 * 0.125, 1e-12);
  EXPECT_FALSE(camera.Project({0.1, 0.1, -1.0}));
}

TEST(FisheyeCamera, RefusesWhatHasNoPixel) {
  const FisheyeCamera camera = PaperCamera();
  EXPECT_FALSE(camera.Project({0.0, 0.0, -1.0}));
  EXPECT_FALSE(camera.Project({std::nan(""), 0.0, 1.0}));
  EXPECT_FALSE(camera.Unproject({643.5 + 601.0 * 3.4, 481.5}));
  EXPECT_FALSE(camera.UnprojectToPlane({643.5 + 601.0 * 1.7, 481.5}));
}

TEST(FisheyeCamera, CheckNamesTheMemberAtFault) {
  FisheyeCamera camera = PaperCamera();
  camera.k = 3.0;
  EXPECT_NE(camera.Check().error().message.find("k 3"), std::string::npos);
}

}  // namespace
}  // namespace foresight
