// What an operator reads of an answer.
#include "core/detection/facts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/geometry/angles.h"

namespace foresight {
namespace {

using testing::HasSubstr;

std::string Told(const std::vector<Fact>& facts, const std::string& name) {
  for (const Fact& fact : facts)
    if (fact.name == name) return fact.value;
  throw std::logic_error("no such fact");
}

/// An upright drill in a frame whose up is -y, as a camera's is: its z is up, its bit points ahead.
DrillDetection UprightInACamerasFrame() {
  DrillDetection drill;
  Eigen::Matrix3d axes;  // columns: the drill's x, y, z
  axes.col(0) = Eigen::Vector3d::UnitZ();
  axes.col(2) = -Eigen::Vector3d::UnitY();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  drill.best.base_from_object = {Eigen::Quaterniond(axes), {0.1, 0.2, 1.5}};
  drill.sigma_axis_rad = RadiansFromDegrees(0.8);
  drill.sigma_yaw_rad = RadiansFromDegrees(2.0);
  return drill;
}

TEST(Facts, OfACloudTellDirectionsByItsOwnUp) {
  const Eigen::Vector3d up = -Eigen::Vector3d::UnitY();
  const auto facts = FactsOf(UprightInACamerasFrame(), 0, {}, up);
  EXPECT_EQ(Told(facts, "Body"), "upright (sigma 0.8 deg)");
  EXPECT_EQ(Told(facts, "Bit points (x)"), "(0.000, 0.000, 1.000), 0.0 deg up (sigma 2.0 deg)");
}

TEST(Facts, OfACloudTellWhichWayADrillLeans) {
  DrillDetection drill = UprightInACamerasFrame();
  const Eigen::Quaterniond lean(
      Eigen::AngleAxisd(RadiansFromDegrees(10.0), Eigen::Vector3d::UnitX()));
  drill.best.base_from_object = {lean * drill.best.base_from_object.rotation(),
                                 drill.best.base_from_object.translation()};
  const auto facts = FactsOf(drill, 0, {}, Eigen::Vector3d(-Eigen::Vector3d::UnitY()));
  EXPECT_EQ(Told(facts, "Body"),
            "leans by 10.0 deg towards (0.000, 0.000, -1.000) (sigma 0.8 deg)");
}

TEST(Facts, OfTheRobotTellDirectionsFromForward) {
  DrillDetection drill;
  drill.best.base_from_object = {
      Eigen::Quaterniond(Eigen::AngleAxisd(RadiansFromDegrees(90.0), Eigen::Vector3d::UnitZ())),
      {1.0, 0.0, 0.8}};
  const auto facts = FactsOf(drill, 0, {});
  EXPECT_THAT(Told(facts, "Bit points (x)"), HasSubstr("90.0 deg left of forward, 0.0 deg up"));
}

TEST(Facts, OfASurfaceThatIsNoBlockClaimNoDeviation) {
  TerrainDetection terrain;
  terrain.surfaces.resize(2);
  terrain.surfaces[0].toehold.sigma_height_m = 0.003;
  terrain.surfaces[0].toehold.sigma_tilt_rad = 0.002;
  EXPECT_THAT(Told(FactsOf(terrain, 0, {}), "Middle"), HasSubstr("sigma 3.0 mm in height"));
  EXPECT_THAT(Told(FactsOf(terrain, 1, {}), "Middle"), Not(HasSubstr("sigma")));
  EXPECT_THAT(Told(FactsOf(terrain, 1, {}), "Normal (z)"), Not(HasSubstr("sigma")));
}

}  // namespace
}  // namespace foresight
