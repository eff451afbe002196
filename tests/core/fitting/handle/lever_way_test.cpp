#include "core/fitting/handle/lever_way.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/base/random.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

constexpr double kDoorAhead_m = 1.2;  // ahead, along x

/// Its pivot lies straight ahead; it points to -y, else to y.
HandleCandidate Lever(bool to_minus_y) {
  const double way = to_minus_y ? -1.0 : 1.0;
  HandleCandidate lever;
  Eigen::Matrix3d axes;  // the door's normal is -x
  axes.col(0) = way * Eigen::Vector3d::UnitY();
  axes.col(2) = -Eigen::Vector3d::UnitX();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  const double pivot_y = to_minus_y ? 0.0 : -lever.model.length_m;  // the same place
  lever.base_from_object = {Eigen::Quaterniond(axes),
                            {kDoorAhead_m - lever.model.standoff_m, pivot_y, 0.0}};
  return lever;
}

/// Rays 0.4 deg apart, half a metre to each side, to what lies `ahead_m` at y.
RaySet RaysOfSlice(const std::function<double(double)>& ahead_m) {
  constexpr double kSigma_m = 0.020;
  Random random(4);
  RaySet set;
  set.sigma_m = kSigma_m;
  for (int line = -20; line <= 20; ++line)
    for (int beam = -60; beam <= 60; ++beam) {
      RangeRay ray;
      ray.origin.setZero();
      ray.direction = Eigen::Vector3d(1.0, 0.007 * beam, 0.007 * line).normalized();
      const double y = kDoorAhead_m * ray.direction.y() / ray.direction.x();
      ray.range_m = ahead_m(y) / ray.direction.x() + kSigma_m * random.Normal();
      set.rays.push_back(ray);
    }
  return set;
}

double Edges(const std::function<double(double)>& ahead_m, bool to_minus_y,
             const Plane& door = {-Eigen::Vector3d::UnitX(), -kDoorAhead_m}) {
  return EdgesForWay(RaysOfSlice(ahead_m), door, Lever(to_minus_y));
}

double FrameAt60(double y) {
  return y > 0.06 ? kDoorAhead_m - 0.02 : kDoorAhead_m;
}

TEST(LeverWay, ALeverPointsFromItsDoorsEdgeIntoTheLeaf) {
  EXPECT_GT(Edges(FrameAt60, true), 3.0);
  EXPECT_LT(Edges(FrameAt60, false), -3.0) << "the edge lies beyond this one's tip";
}

TEST(LeverWay, ADoorWithoutAnEdgeSaysNothing) {
  EXPECT_EQ(Edges([](double) { return kDoorAhead_m; }, true), 0.0);
}

TEST(LeverWay, EdgesAsNearToBothSidesSayNothing) {
  const double far_end = -HandleCandidate().model.length_m;
  const auto panel = [&](double y) {
    return y > 0.06 || y < far_end - 0.06 ? kDoorAhead_m - 0.02 : kDoorAhead_m;
  };
  EXPECT_EQ(Edges(panel, true), 0.0);
}

TEST(LeverWay, TheNearerOfTwoEdgesIsTheDoors) {
  const double far_end = -HandleCandidate().model.length_m;
  const auto panel = [&](double y) {
    return y > 0.06 || y < far_end - 0.13 ? kDoorAhead_m - 0.02 : kDoorAhead_m;
  };
  EXPECT_GT(Edges(panel, true), 3.0);
}

TEST(LeverWay, RoundAPlaneThatIsNoDoorEdgesSayNothing) {
  const double turn = RadiansFromDegrees(15.0);
  const Eigen::Vector3d normal(-std::cos(turn), std::sin(turn), 0.0);
  EXPECT_EQ(Edges(FrameAt60, true, {normal, -kDoorAhead_m * std::cos(turn)}), 0.0);
}

}  // namespace
}  // namespace foresight
