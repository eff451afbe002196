#include "core/fitting/solids/solid_coverage.h"

#include <gtest/gtest.h>

#include <memory>

namespace foresight {
namespace {

/// Nine rays along x in a row along y, 20 mm apart.
RaySet Row() {
  RaySet rays;
  for (int i = -4; i <= 4; ++i)
    rays.rays.push_back({{0.0, 0.02 * i, 0.0}, Eigen::Vector3d::UnitX(), 1.0, {i + 4, 0}});
  return rays;
}

SolidPart Box() {
  SolidPart box;
  box.shape = SolidPart::Shape::kBox;
  box.size_m = {0.05, 0.05, 0.05};
  return box;
}

const Rigid<frame::Base, frame::Object> kAhead{Eigen::Quaterniond::Identity(), {1.0, 0.0, 0.0}};

TEST(RaysNear, KeepWhatPassesWithinReachAlone) {
  RaySet rays = Row();
  rays.beams = std::make_shared<const RaySet>(Row());
  const SolidPart parts[] = {Box()};
  const RaySet near = RaysNear(rays, parts, kAhead, 0.02);
  EXPECT_EQ(near.rays.size(), 5U);  // up to 45 mm beside the middle
  EXPECT_EQ(near.beams, nullptr);
  EXPECT_EQ(near.image, nullptr);
  EXPECT_EQ(near.sigma_m, rays.sigma_m);
}

TEST(LogLikelihoodOfSolids, IsThatOfTheBeamsWhereThereIsNoImage) {
  RaySet rays = Row();
  for (RangeRay& ray : rays.rays) ray.range_m = std::abs(ray.origin.y()) < 0.025 ? 0.975 : 1.3;
  const Plane wall{-Eigen::Vector3d::UnitX(), -1.3};
  const BeamLikelihood likelihood(rays, {&wall, 1});
  const SolidPart parts[] = {Box()};
  const double there = LogLikelihoodOf(parts, kAhead, likelihood);
  EXPECT_EQ(there, likelihood(CoverBy(SolidTracer(parts, kAhead))));
  EXPECT_GT(there, likelihood.Nothing() + 5.0);
  const Rigid<frame::Base, frame::Object> beside{Eigen::Quaterniond::Identity(), {1.0, 0.06, 0.0}};
  EXPECT_LT(LogLikelihoodOf(parts, beside, likelihood), likelihood.Nothing());
}

}  // namespace
}  // namespace foresight
