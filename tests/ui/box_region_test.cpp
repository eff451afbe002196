#include "ui/viewmodels/box_region.h"

#include <gtest/gtest.h>

#include <cmath>

namespace foresight {
namespace {

const Rigid<frame::Robot, frame::Base> kUpright(
    (Eigen::Matrix3d() << 0, 0, 1, -1, 0, 0, 0, -1, 0).finished(), {0.1, 0.0, 1.4});

/// Looks along the robot's x from its origin, 45 deg to each side.
Eigen::Matrix4d LookAhead() {
  Eigen::Matrix4d clip = Eigen::Matrix4d::Zero();
  clip(0, 1) = -1.0;
  clip(1, 2) = 1.0;
  clip(3, 0) = 1.0;
  return clip;
}

/// A grid on a plane x = `distance` of robot, from low to high in y and z; in base.
void AddPlate(double distance_m, double half_m, std::vector<Eigen::Vector3f>& points) {
  for (double y = -half_m; y <= half_m; y += 0.01)
    for (double z = -half_m; z <= half_m; z += 0.01)
      points.push_back((kUpright.Inverse() * Eigen::Vector3d(distance_m, y, z)).cast<float>());
}

CloudRectangle Ahead(double half) {
  return {LookAhead(), {{-half, -half}, {half, half}}};
}

TEST(BoxUnder, IsRoundTheNearestThingsAndLeavesOutWhatLiesFarBehind) {
  std::vector<Eigen::Vector3f> points;
  AddPlate(1.0, 0.2, points);
  AddPlate(1.15, 0.5, points);  // the wall behind belongs to the region
  AddPlate(3.0, 1.5, points);   // the room's far end does not
  points.push_back(Eigen::Vector3f::Constant(NAN));
  const auto box = BoxUnder(Ahead(0.3), points, kUpright, nullptr);
  ASSERT_TRUE(box);
  EXPECT_TRUE(box->Check());
  const Eigen::Vector3d center = kUpright * box->base_from_box.translation();
  EXPECT_NEAR(center.x(), 1.075, 0.005);
  EXPECT_NEAR(center.y(), 0.0, 0.02);
  EXPECT_NEAR(box->size_m.x(), 0.15 + 0.02, 0.005);
  EXPECT_NEAR(box->size_m.y(), 2 * 0.3 * 1.15 + 0.02, 0.04);
  EXPECT_TRUE(box->Contains(kUpright.Inverse() * Eigen::Vector3d(1.0, 0.15, -0.15)));
  EXPECT_FALSE(box->Contains(kUpright.Inverse() * Eigen::Vector3d(3.0, 0.0, 0.0)));
}

TEST(BoxUnder, ACutKeepsOnlyWhatWasInTheBoxBefore) {
  std::vector<Eigen::Vector3f> points;
  AddPlate(1.0, 0.2, points);
  AddPlate(3.0, 1.5, points);
  const auto whole = BoxUnder(Ahead(0.3), points, kUpright, nullptr);
  ASSERT_TRUE(whole);
  const auto cut = BoxUnder(Ahead(0.1), points, kUpright, &*whole);
  ASSERT_TRUE(cut);
  EXPECT_NEAR(cut->size_m.y(), 0.2 + 0.02, 0.02);
  EXPECT_NEAR((kUpright * cut->base_from_box.translation()).x(), 1.0, 0.005);
}

TEST(BoxUnder, NothingUnderTheRectangleIsNoBox) {
  std::vector<Eigen::Vector3f> points;
  AddPlate(-1.0, 0.5, points);  // behind the viewer
  EXPECT_FALSE(BoxUnder(Ahead(0.5), points, kUpright, nullptr));
  EXPECT_FALSE(BoxUnder(Ahead(0.5), {}, kUpright, nullptr));
}

}  // namespace
}  // namespace foresight
