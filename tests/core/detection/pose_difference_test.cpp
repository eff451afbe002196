#include "core/detection/pose_difference.h"

#include <gtest/gtest.h>

#include "core/geometry/angles.h"

namespace foresight {
namespace {

using RobotFromObject = Rigid<frame::Robot, frame::Object>;

Eigen::Quaterniond About(const Eigen::Vector3d& axis, double angle_deg) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(RadiansFromDegrees(angle_deg), axis));
}

PlacedObject At(const Eigen::Vector3d& position, const Eigen::Quaterniond& rotation, int turns = 1,
                const char* kind = "valve") {
  PlacedObject object;
  object.kind = kind;
  object.robot_from_object = RobotFromObject(rotation, position);
  object.turns = turns;
  return object;
}

const Eigen::Vector3d kX = Eigen::Vector3d::UnitX(), kZ = Eigen::Vector3d::UnitZ();

TEST(PoseDifference, IsGivenInTheAxesOfTheFirst) {
  // The first object's x is the robot's y.
  const PlacedObject first = At({1.0, 0.0, 0.0}, About(kZ, 90.0));
  const PlacedObject second = At({1.0, 0.003, 0.0}, About(kZ, 90.0) * About(kX, 2.0));
  const PoseDifference difference = DifferenceOf(first, second);
  EXPECT_NEAR(difference.distance_m, 0.003, 1e-12);
  EXPECT_TRUE(difference.shift_m.isApprox(Eigen::Vector3d(0.003, 0.0, 0.0), 1e-9));
  EXPECT_NEAR(DegreesFromRadians(difference.angle_rad), 2.0, 1e-9);
  EXPECT_NEAR(DegreesFromRadians(difference.turn_rad.x()), 2.0, 1e-9);
}

TEST(PoseDifference, AWheelIsTheSameAfterATurnFromSpokeToSpoke) {
  const PlacedObject wheel = At({1.0, 0.0, 0.0}, About(kX, 30.0), 4);
  const PlacedObject turned = At({1.0, 0.0, 0.0}, About(kX, 30.0) * About(kZ, 91.0), 4);
  EXPECT_NEAR(DegreesFromRadians(DifferenceOf(wheel, turned).angle_rad), 1.0, 1e-9);
}

TEST(PoseDifference, OfADiscAndOfWheelsWithOtherSpokesOnlyTheAxisCounts) {
  const auto tilted = About(kX, 3.0) * About(kZ, 50.0);
  for (const auto& [first, second] : {std::pair(0, 0), std::pair(3, 4)}) {
    const PlacedObject wheel = At({1.0, 0.0, 0.0}, Eigen::Quaterniond::Identity(), first);
    EXPECT_NEAR(
        DegreesFromRadians(DifferenceOf(wheel, At({1.0, 0.0, 0.0}, tilted, second)).angle_rad), 3.0,
        1e-6);
  }
}

TEST(PoseDifference, AnyOtherObjectKeepsEveryTurn) {
  const PlacedObject drill = At({1.0, 0.0, 0.0}, Eigen::Quaterniond::Identity(), 1, "drill");
  const PlacedObject flipped = At({1.0, 0.0, 0.0}, About(kZ, 179.0), 1, "drill");
  EXPECT_NEAR(DegreesFromRadians(DifferenceOf(drill, flipped).angle_rad), 179.0, 1e-6);
}

TEST(MatchObjects, PairsByKindAndPlaceAndListsWhatIsLeftOver) {
  const Eigen::Quaterniond level = Eigen::Quaterniond::Identity();
  const std::vector<PlacedObject> first = {At({1.0, 0.0, 1.0}, level), At({1.0, 0.2, 1.0}, level),
                                           At({2.0, 0.0, 1.0}, level, 1, "drill")};
  // Both valves are within reach of both: the nearest pairs count.
  const std::vector<PlacedObject> second = {At({1.0, 0.19, 1.0}, level),
                                            At({1.0, 0.02, 1.0}, level),
                                            At({2.0, 0.9, 1.0}, level, 1, "drill")};
  const std::vector<ObjectPair> pairs = MatchObjects(first, second);
  ASSERT_EQ(pairs.size(), 4u);
  EXPECT_NEAR(pairs[0].difference->distance_m, 0.02, 1e-12);
  EXPECT_NEAR(pairs[1].difference->distance_m, 0.01, 1e-12);
  EXPECT_TRUE(pairs[2].first && !pairs[2].second && pairs[2].first->kind == "drill");
  EXPECT_TRUE(!pairs[3].first && pairs[3].second && !pairs[3].difference);
}

TEST(MatchObjects, AValveIsNeverTheDrillBesideIt) {
  const Eigen::Quaterniond level = Eigen::Quaterniond::Identity();
  const auto pairs =
      MatchObjects({At({1.0, 0.0, 1.0}, level)}, {At({1.0, 0.0, 1.0}, level, 1, "drill")});
  ASSERT_EQ(pairs.size(), 2u);
  EXPECT_FALSE(pairs[0].difference || pairs[1].difference);
}

}  // namespace
}  // namespace foresight
