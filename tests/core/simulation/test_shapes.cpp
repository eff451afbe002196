#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/simulation/shapes.h"

namespace foresight {
namespace {

constexpr double kPi = std::numbers::pi;

/// By the divergence theorem: right only for a closed surface with all triangles wound outwards.
double VolumeOf(const Shape& shape) {
  double volume = 0.0;
  for (const Eigen::Vector3i& t : shape.triangles) {
    const Eigen::Vector3d a = shape.vertices[static_cast<std::size_t>(t[0])].cast<double>();
    const Eigen::Vector3d b = shape.vertices[static_cast<std::size_t>(t[1])].cast<double>();
    const Eigen::Vector3d c = shape.vertices[static_cast<std::size_t>(t[2])].cast<double>();
    volume += a.dot(b.cross(c)) / 6.0;
  }
  return volume;
}

// 128 corners to a turn cut 0.04 % off a circle's area, 32 cut 0.64 % off a torus's tube.
constexpr double kRoundFraction = 0.001;
constexpr double kTubeFraction = 0.008;

TEST(Shapes, BoxIsClosedAndWoundOutwards) {
  EXPECT_NEAR(VolumeOf(BoxShape({0.2, 0.3, 0.4})), 0.024, 1e-8);
}

TEST(Shapes, CylinderIsClosedAndWoundOutwards) {
  const double expected = kPi * 0.1 * 0.1 * 0.5;
  EXPECT_NEAR(VolumeOf(CylinderShape(0.1, 0.5)), expected, kRoundFraction * expected);
}

TEST(Shapes, SphereIsClosedAndWoundOutwards) {
  const double expected = 4.0 / 3.0 * kPi * 0.3 * 0.3 * 0.3;
  EXPECT_NEAR(VolumeOf(SphereShape(0.3)), expected, 3.0 * kRoundFraction * expected);
}

TEST(Shapes, CapsuleIsACylinderBetweenTwoHalfSpheres) {
  const double expected = kPi * 0.01 * 0.5 + 4.0 / 3.0 * kPi * 0.001;
  EXPECT_NEAR(VolumeOf(CapsuleShape(0.1, 0.5)), expected, 2.0 * kRoundFraction * expected);
}

TEST(Shapes, TorusIsClosedAndWoundOutwards) {
  const double expected = 2.0 * kPi * kPi * 0.15 * 0.012 * 0.012;
  EXPECT_NEAR(VolumeOf(TorusShape(0.15, 0.012)), expected, kTubeFraction * expected);
}

TEST(Shapes, FlatDishIsAPlateOfItsThickness) {
  const double expected = kPi * 0.15 * 0.15 * 0.01;
  EXPECT_NEAR(VolumeOf(DishShape(0.15, 0.0, 0.01)), expected, kRoundFraction * expected);
}

TEST(Shapes, ASweptSectionIsClosedAndWoundOutwards) {
  const std::vector<Eigen::Vector2d> section = {
      {-0.01, -0.02}, {0.01, -0.02}, {0.01, 0.02}, {-0.01, 0.02}};
  const std::vector<Eigen::Vector3d> straight = {{0.0, 0.0, 0.1}, {0.3, 0.0, 0.1}};
  EXPECT_NEAR(VolumeOf(SweptShape(section, straight, Eigen::Vector3d::UnitZ())), 0.00024, 1e-9);
  // x of the section lies across the path, y stays up.
  float high = 0.0f;
  for (const Eigen::Vector3f& v : SweptShape(section, straight, Eigen::Vector3d::UnitZ()).vertices)
    high = std::max(high, v.z());
  EXPECT_NEAR(high, 0.12f, 1e-6f);
}

TEST(Shapes, ASectionThatShrinksToHalfIsThePartOfAPyramid) {
  const std::vector<Eigen::Vector2d> section = {{-0.1, -0.1}, {0.1, -0.1}, {0.1, 0.1}, {-0.1, 0.1}};
  const std::vector<Eigen::Vector3d> path = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.6}};
  const std::vector<double> scales = {1.0, 0.5};
  EXPECT_NEAR(VolumeOf(SweptShape(section, path, Eigen::Vector3d::UnitY(), scales)),
              0.6 / 3.0 * (0.04 + 0.02 + 0.01), 1e-8);
}

TEST(Shapes, ARevolvedRectangleIsARingOfItsSection) {
  const std::vector<Eigen::Vector2d> section = {
      {0.14, -0.01}, {0.16, -0.01}, {0.16, 0.01}, {0.14, 0.01}};
  const double expected = 2.0 * kPi * 0.15 * 0.0004;
  EXPECT_NEAR(VolumeOf(RevolvedShape(section, true)), expected, kRoundFraction * expected);
}

TEST(Shapes, NoTriangleIsWithoutArea) {
  for (const Shape& shape : {SphereShape(0.1), CylinderShape(0.1, 0.2), CapsuleShape(0.1, 0.2),
                             DishShape(0.15, 0.03, 0.01)})
    for (const Eigen::Vector3i& t : shape.triangles) {
      const Eigen::Vector3f& a = shape.vertices[static_cast<std::size_t>(t[0])];
      const Eigen::Vector3f& b = shape.vertices[static_cast<std::size_t>(t[1])];
      const Eigen::Vector3f& c = shape.vertices[static_cast<std::size_t>(t[2])];
      // The slimmest, at a sphere's pole, has 1e-6 m2.
      ASSERT_GT((b - a).cross(c - a).norm(), 1e-8f);
    }
}

TEST(Shapes, PoseAlongPutsTheEndsOfAShapeOnTheTwoPoints) {
  const Eigen::Vector3d from(1.0, 2.0, 3.0);
  const Eigen::Vector3d to(1.5, 1.0, 2.0);
  const double half = 0.5 * (to - from).norm();
  const auto pose = PoseAlong(from, to);
  EXPECT_LT((pose * Eigen::Vector3d(0.0, 0.0, -half) - from).norm(), 1e-12);
  EXPECT_LT((pose * Eigen::Vector3d(0.0, 0.0, half) - to).norm(), 1e-12);
}

}  // namespace
}  // namespace foresight
