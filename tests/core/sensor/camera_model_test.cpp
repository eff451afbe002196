#include "core/sensor/camera_model.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <type_traits>

#include "core/base/random.h"
#include "tests/core/sensor/known_cameras.h"

namespace foresight {
namespace {

Eigen::Vector3d RandomDirection(Random& random) {
  const double z = random.Uniform(-1.0, 1.0);
  const double azimuth = random.Uniform(-3.2, 3.2);
  const double across = std::sqrt(1.0 - z * z);
  return {across * std::cos(azimuth), across * std::sin(azimuth), z};
}

double AngleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Pixels of the image and of a margin of half its size all round.
std::vector<Eigen::Vector2d> PixelsAndBeyond(const CameraModel& camera) {
  std::vector<Eigen::Vector2d> pixels;
  constexpr int kSteps = 60;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= kSteps; ++j)
      pixels.emplace_back((2.0 * i / kSteps - 0.5) * camera.width,
                          (2.0 * j / kSteps - 0.5) * camera.height);
  return pixels;
}

TEST(CameraModel, EveryModelProjectsWhatItUnprojects) {
  for (const auto& [what, camera, shows_all] : KnownCameras()) {
    SCOPED_TRACE(what);
    ASSERT_TRUE(camera.Check());
    int seen = 0, asked = 0;
    for (const Eigen::Vector2d& pixel : PixelsAndBeyond(camera)) {
      ++asked;
      const auto ray = camera.Unproject(pixel);
      if (!ray) continue;
      ++seen;
      ASSERT_NEAR(ray->norm(), 1.0, 1e-15);
      const auto back = camera.Project(2.5 * *ray);
      ASSERT_TRUE(back) << pixel.transpose();
      // The bar of the round trip: 1e-9 px.
      ASSERT_LT((*back - pixel).norm(), 1e-9) << pixel.transpose();
    }
    EXPECT_EQ(seen == asked, shows_all) << seen << " of " << asked;
    EXPECT_GT(seen, asked / 10);
  }
}

TEST(CameraModel, NoTwoDirectionsShareAPixel) {
  Random random(3);
  for (const auto& [what, camera, shows_all] : KnownCameras()) {
    SCOPED_TRACE(what);
    int seen = 0;
    for (int i = 0; i < 3000; ++i) {
      const Eigen::Vector3d direction = RandomDirection(random);
      const auto pixel = camera.Project(2.5 * direction);
      if (!pixel) continue;
      ++seen;
      const auto ray = camera.Unproject(*pixel);
      ASSERT_TRUE(ray) << direction.transpose();
      // Where a lens folds back its pixels say little of the angle, but never name another one.
      ASSERT_LT(AngleBetween(*ray, direction), 1e-6) << direction.transpose();
    }
    EXPECT_GT(seen, 0);
  }
}

/// A lens with parameters from anywhere in the range that has a meaning.
Lens RandomLens(Random& random, int model) {
  const auto of_scale = [&random](double largest) {
    // Some tiny, some huge, of either sign.
    return largest * std::pow(random.Uniform(-1.0, 1.0), 5);
  };
  switch (model) {
    case 0:
      return FisheyeLens{random.Uniform(0.051, 1.999)};
    case 1:
      return RadialTangentialLens(of_scale(5), of_scale(10), of_scale(1), of_scale(1),
                                  of_scale(20));
    case 2:
      return KannalaBrandtLens(of_scale(3), of_scale(3), of_scale(3), of_scale(3));
    default:
      return ExtendedUnifiedLens{random.Uniform(0.0, 1.0), std::pow(10, random.Uniform(-2, 2))};
  }
}

TEST(CameraModel, InvertsLensesOfAnyParameters) {
  Random random(4);
  int pixels = 0, directions = 0;
  for (int i = 0; i < 400; ++i) {
    const CameraModel camera{.width = 100,
                             .height = 100,
                             .fx = 50.0,
                             .fy = 51.0,
                             .cx = 50.0,
                             .cy = 49.0,
                             .lens = RandomLens(random, i % 4)};
    SCOPED_TRACE(fmt::format("{} {}", camera.Key(), fmt::join(camera.Values(), " ")));
    ASSERT_TRUE(camera.Check());
    for (int j = 0; j < 100; ++j) {
      const Eigen::Vector2d pixel(random.Uniform(-50, 150), random.Uniform(-50, 150));
      if (const auto ray = camera.Unproject(pixel)) {
        ++pixels;
        const auto back = camera.Project(*ray);
        ASSERT_TRUE(back);
        ASSERT_LT((*back - pixel).norm(), 1e-9);
      }
      const Eigen::Vector3d direction = RandomDirection(random);
      if (const auto seen = camera.Project(direction); seen && seen->norm() < 1e4) {
        ++directions;
        const auto ray = camera.Unproject(*seen);
        ASSERT_TRUE(ray) << direction.transpose();
        // Pixels may say little of the angle near a lens's end; they never name another one.
        const auto again = camera.Project(*ray);
        ASSERT_LT((*again - *seen).norm(), 1e-9);
        ASSERT_LT(AngleBetween(*ray, direction), 1e-5) << direction.transpose();
      }
    }
  }
  // Of 40000 each; a lens that shows nothing would pass.
  EXPECT_GT(pixels, 10000);
  EXPECT_GT(directions, 10000);
}

/// The derivative of `function` at 0 from four values, error of order step^4.
template <class Function>
std::optional<Eigen::Vector2d> Difference(const Function& function, double step) {
  const auto a = function(-2 * step), b = function(-step), c = function(step),
             d = function(2 * step);
  if (!a || !b || !c || !d) return std::nullopt;
  return (*a - 8.0 * *b + 8.0 * *c - *d) / (12.0 * step);
}

TEST(CameraModel, DerivativesAgreeWithDifferences) {
  Random random(2);
  for (const auto& [what, camera, shows_all] : KnownCameras()) {
    SCOPED_TRACE(what);
    int compared = 0;
    for (int i = 0; i < 300; ++i) {
      // In front, beside and behind; near the axis too, but not near the backward one, where a
      // small step goes half round.
      const double spread = i % 4 == 0 && i % 5 != 4 ? 0.004 : 1.5;
      const Eigen::Vector3d point(random.Uniform(-spread, spread), random.Uniform(-spread, spread),
                                  i % 5 == 4 ? -0.2 : random.Uniform(1.0, 3.0));
      CameraModel::ByPoint by_point;
      CameraModel::ByParameters by_parameters;
      const auto pixel = camera.Project(point, &by_point, &by_parameters);
      // Of larger numbers a difference keeps too few digits.
      if (!pixel || pixel->norm() > 2e4) continue;
      for (int axis = 0; axis < 3; ++axis) {
        const auto numeric = Difference(
            [&](double s) { return camera.Project(point + s * Eigen::Vector3d::Unit(axis)); },
            2e-5);
        if (!numeric) continue;
        ++compared;
        ASSERT_LT((by_point.col(axis) - *numeric).norm(), 1e-6 * (1.0 + numeric->norm()))
            << point.transpose();
      }
      ASSERT_EQ(by_parameters.cols(), camera.Values().size());
      for (Eigen::Index parameter = 0; parameter < by_parameters.cols(); ++parameter) {
        const auto numeric = Difference(
            [&](double s) {
              CameraModel::Parameters values = camera.Values();
              values[parameter] += s;
              return camera.WithValues(values).Project(point);
            },
            2e-5);
        if (!numeric) continue;
        ++compared;
        ASSERT_LT((by_parameters.col(parameter) - *numeric).norm(), 1e-6 * (1.0 + numeric->norm()))
            << camera.ParameterNames()[static_cast<std::size_t>(parameter)] << " at "
            << point.transpose();
      }
    }
    EXPECT_GT(compared, 300);
  }
}

TEST(CameraModel, HasNoPixelForWhatIsNoDirection) {
  for (const auto& [what, camera, shows_all] : KnownCameras()) {
    SCOPED_TRACE(what);
    EXPECT_FALSE(camera.Project(Eigen::Vector3d::Zero()));
    EXPECT_FALSE(camera.Project({0.0, 0.0, -1.0}));
    EXPECT_FALSE(camera.Project({std::nan(""), 0.0, 1.0}));
    EXPECT_FALSE(camera.Project({1e300, 0.0, 1.0}));
  }
}

TEST(CameraModel, IsAValueWithoutAllocation) {
  EXPECT_TRUE(std::is_trivially_copyable_v<CameraModel>);
  const CameraModel camera = KnownCameras().front().camera;
  CameraModel other = camera;
  EXPECT_EQ(other, camera);
  other.lens = FisheyeLens{0.9414};
  EXPECT_NE(other, camera);
  other.lens = KannalaBrandtLens();
  EXPECT_NE(other, camera);
}

TEST(CameraModel, GivesItsParametersInTheOrderOfTheirNames) {
  const CameraModel camera{.width = 4,
                           .height = 3,
                           .fx = 1,
                           .fy = 2,
                           .cx = 3,
                           .cy = 4,
                           .lens = RadialTangentialLens(0.1, 0.2, 0.3, 0.4, 0.5)};
  const std::vector<std::string_view> names = {"fx", "fy", "cx", "cy", "k1",
                                               "k2", "p1", "p2", "k3"};
  EXPECT_EQ(camera.ParameterNames(), names);
  CameraModel::Parameters values(9);
  values << 1, 2, 3, 4, 0.1, 0.2, 0.3, 0.4, 0.5;
  EXPECT_EQ(camera.Values(), values);
  EXPECT_EQ(camera.WithValues(values), camera);
}

TEST(CameraModel, CheckNamesTheParameterAtFault) {
  const CameraModel good = KnownCameras().front().camera;
  const auto fault = [&good](const auto& change) {
    CameraModel camera = good;
    change(camera);
    const Status status = camera.Check();
    return status ? std::string("none") : status.error().message;
  };
  EXPECT_EQ(fault([](CameraModel&) {}), "none");
  EXPECT_NE(fault([](CameraModel& c) { c.lens = FisheyeLens{3.0}; }).find("k 3"),
            std::string::npos);
  EXPECT_NE(fault([](CameraModel& c) { c.width = 0; }).find("image size 0 x"), std::string::npos);
  EXPECT_NE(fault([](CameraModel& c) { c.fy = -1.0; }).find("fy -1"), std::string::npos);
  EXPECT_NE(fault([](CameraModel& c) { c.cx = std::nan(""); }).find("principal point (nan"),
            std::string::npos);
  EXPECT_NE(fault([](CameraModel& c) {
              c.lens = KannalaBrandtLens(0, 0, std::nan(""), 0);
            }).find("k3 nan"),
            std::string::npos);
  EXPECT_NE(
      fault([](CameraModel& c) { c.lens = RadialTangentialLens(0, 0, 2, 0, 0); }).find("p1 2"),
      std::string::npos);
  EXPECT_NE(fault([](CameraModel& c) {
              c.lens = ExtendedUnifiedLens{1.1, 1.0};
            }).find("alpha 1.1"),
            std::string::npos);
  EXPECT_NE(fault([](CameraModel& c) {
              c.lens = ExtendedUnifiedLens{0.5, 0.0};
            }).find("beta 0"),
            std::string::npos);
}

}  // namespace
}  // namespace foresight
