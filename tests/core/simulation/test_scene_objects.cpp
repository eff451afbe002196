#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/simulation/scene_objects.h"

namespace foresight {
namespace {

ValveObject SomeValve(int spokes) {
  ValveObject valve;
  valve.name = "wheel";
  valve.robot_from_object = ValvePose({1.4, 0.1, 1.2}, {-0.9, 0.3, 0.2}, 0.4);
  valve.model = {.rim_radius_m = 0.15,
                 .tube_radius_m = 0.012,
                 .spokes = spokes,
                 .spoke_radius_m = 0.009,
                 .hub_radius_m = 0.024,
                 .dish_m = 0.03};
  return valve;
}

/// The largest and smallest signed distance of the wheel's vertices to the analytic model.
std::pair<double, double> DistancesToModel(const ValveObject& valve) {
  Scene scene;
  AddValve(valve, scene);
  double smallest = 1.0;
  double largest = -1.0;
  for (const Eigen::Vector3f& vertex : scene.meshes.front().vertices) {
    const double distance =
        valve.model.Distance(valve.robot_from_object.Inverse() * vertex.cast<double>());
    smallest = std::min(smallest, distance);
    largest = std::max(largest, distance);
  }
  return {smallest, largest};
}

TEST(ValveObject, NoVertexOfTheWheelLiesOutsideTheModelThatIsItsTruth) {
  // Single precision at 2 m resolves 0.2 um; inside are the ends of spokes within hub and rim.
  for (const int spokes : {2, 3, 5, 6}) {
    const auto [smallest, largest] = DistancesToModel(SomeValve(spokes));
    EXPECT_NEAR(largest, 0.0, 1e-6) << spokes;
    EXPECT_GT(smallest, -0.0245) << spokes;
  }
}

TEST(ValveObject, FlatSectionsFollowTheModelToo) {
  for (const double ratio : {0.3, 2.0}) {
    ValveObject valve = SomeValve(4);
    valve.model.rim_depth_ratio = ratio;
    valve.model.spoke_depth_ratio = ratio;
    const auto [smallest, largest] = DistancesToModel(valve);
    EXPECT_NEAR(largest, 0.0, 2e-6) << ratio;
    EXPECT_GT(smallest, -0.0245) << ratio;
  }
}

TEST(ValveObject, ADiscFollowsTheModelToo) {
  // The model's disc bends around the rim and the hub with half its thickness; ours is a flat cone.
  const auto [smallest, largest] = DistancesToModel(SomeValve(0));
  EXPECT_LT(largest, 1e-6);
}

TEST(ValveObject, FirstSpokePointsUpAndTheAxisToTheViewerAtPhaseZero) {
  const auto pose = ValvePose({1.0, 0.0, 1.0}, {-1.0, 0.0, 0.0}, 0.0);
  EXPECT_LT((pose.Rotate(Eigen::Vector3d::UnitZ()) + Eigen::Vector3d::UnitX()).norm(), 1e-12);
  EXPECT_LT((pose.Rotate(Eigen::Vector3d::UnitX()) - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
}

TEST(ValveObject, PositivePhaseTurnsTheFirstSpokeToTheViewersLeft) {
  // Robot y is the left of a viewer who looks along +x.
  const auto pose = ValvePose({1.0, 0.0, 1.0}, {-1.0, 0.0, 0.0}, 0.5 * std::numbers::pi);
  EXPECT_LT((pose.Rotate(Eigen::Vector3d::UnitX()) - Eigen::Vector3d::UnitY()).norm(), 1e-12);
}

TEST(DrillObject, StandsOnItsOriginWithItsBitForwards) {
  Scene scene;
  AddDrill(DrillObject(), scene);
  Eigen::Vector3f low = Eigen::Vector3f::Constant(1.0f);
  Eigen::Vector3f high = -low;
  for (const SceneMesh& mesh : scene.meshes)
    for (const Eigen::Vector3f& vertex : mesh.vertices) {
      low = low.cwiseMin(vertex);
      high = high.cwiseMax(vertex);
    }
  EXPECT_NEAR(low.z(), 0.0, 1e-6);
  EXPECT_NEAR(high.z(), 0.242, 1e-4);  // head of 68 mm around 208 mm
  EXPECT_NEAR(high.x(), 0.205, 1e-4);  // the tip of the bit
  EXPECT_NEAR(low.x(), -0.104, 1e-4);  // the round back of the head
  EXPECT_NEAR(high.y(), -low.y(), 1e-6);
}

TEST(BlockObject, TopFaceIsCentredOnItsTruth) {
  Scene scene;
  const Rigid<frame::Robot, frame::Object> pose(
      Eigen::Quaterniond(Eigen::AngleAxisd(0.26, Eigen::Vector3d::UnitY())), {2.0, 0.5, 0.19});
  AddBlock({.name = "block", .robot_from_object = pose, .material = {}}, scene);
  Eigen::Vector3d low = Eigen::Vector3d::Constant(1.0);
  Eigen::Vector3d high = -low;
  for (const Eigen::Vector3f& vertex : scene.meshes.front().vertices) {
    const Eigen::Vector3d in_block =
        scene.blocks.front().robot_from_object.Inverse() * vertex.cast<double>();
    low = low.cwiseMin(in_block);
    high = high.cwiseMax(in_block);
  }
  EXPECT_LT((high - Eigen::Vector3d(0.1985, 0.195, 0.0)).norm(), 1e-6);
  EXPECT_LT((low - Eigen::Vector3d(-0.1985, -0.195, -0.143)).norm(), 1e-6);
}

}  // namespace
}  // namespace foresight
