#include "core/fitting/solids/part_edges.h"

#include <gtest/gtest.h>

#include <cmath>

namespace foresight {
namespace {

SolidPart Part(SolidPart::Shape shape, const Eigen::Vector3d& size_m) {
  SolidPart part;
  part.shape = shape;
  part.size_m = size_m;
  return part;
}

TEST(PartEdges, OfABoxFromItsFrontAreFourAndFromACornerSix) {
  const SolidPart box = Part(SolidPart::Shape::kBox, {0.2, 0.1, 0.3});
  EXPECT_EQ(EdgesSeenFrom(box, {0.0, 0.0, 2.0}).size(), 4u);
  EXPECT_EQ(EdgesSeenFrom(box, {1.0, 1.0, 1.0}).size(), 6u);
}

TEST(PartEdges, OfACylinderAreWhereTheSightTouchesItAndHalfOfItsRims) {
  const SolidPart cylinder = Part(SolidPart::Shape::kCylinder, {0.1, 0.1, 0.3});
  const Eigen::Vector3d eye(2.0, 0.0, 0.0);
  int sides = 0;
  for (const PartEdge& edge : EdgesSeenFrom(cylinder, eye)) {
    if (edge.from.head<2>() != edge.to.head<2>()) continue;
    ++sides;
    EXPECT_NEAR(edge.from.head<2>().norm(), 0.05, 1e-9);
    // The sight is a tangent there.
    const Eigen::Vector2d sight = eye.head<2>() - edge.from.head<2>();
    EXPECT_NEAR(sight.dot(edge.from.head<2>()), 0.0, 1e-9);
  }
  EXPECT_EQ(sides, 2);
  // From above its whole upper rim is one.
  for (const PartEdge& edge : EdgesSeenFrom(cylinder, {0.0, 0.0, 2.0}))
    EXPECT_NEAR(edge.from.z(), 0.15, 1e-9);
  EXPECT_EQ(EdgesSeenFrom(cylinder, {0.0, 0.0, 2.0}).size(), 16u);
}

TEST(PartEdges, OfABallAreACircleAcrossTheSight) {
  const SolidPart ball = Part(SolidPart::Shape::kCapsule, {0.1, 0.1, 0.0});
  const Eigen::Vector3d eye = Eigen::Vector3d(1.0, 2.0, 0.5);
  const auto edges = EdgesSeenFrom(ball, eye);
  ASSERT_FALSE(edges.empty());
  for (const PartEdge& edge : edges) {
    EXPECT_NEAR(edge.from.norm(), 0.05, 1e-9);
    EXPECT_NEAR(edge.from.dot(eye), 0.0, 1e-9);
  }
}

}  // namespace
}  // namespace foresight
