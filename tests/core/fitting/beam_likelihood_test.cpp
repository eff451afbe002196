#include "core/fitting/beam_likelihood.h"

#include <gtest/gtest.h>

#include <memory>
#include <optional>

#include "core/fitting/beam_model.h"
#include "core/fitting/sampled_coverage.h"
#include "core/fitting/wall.h"

namespace foresight {
namespace {

constexpr double kObject_m = 2.0, kWall_m = 2.2;
const Plane kWall{-Eigen::Vector3d::UnitX(), -kWall_m};

/// Beams of one line along x that all read `range_m`, footprints 10 mm wide at 2 m.
RaySet Beams(double range_m, int count = 1) {
  RaySet rays;
  rays.sigma_m = 0.005;
  rays.footprint_rad = 0.005;
  for (int i = 0; i < count; ++i)
    rays.rays.push_back({Eigen::Vector3d::Zero(),
                         Eigen::Vector3d(1.0, 0.003 * i, 0.0).normalized(),
                         range_m,
                         {i, 0}});
  return rays;
}

/// Everything above z = `edge_m` at 2 m, as far as rays along x can tell.
IntersectBeam HalfSpaceAbove(double edge_m) {
  return [edge_m](const RangeRay& ray, double reach_m) -> std::optional<BeamIntersection> {
    const double clearance_m = edge_m - kObject_m * ray.direction.z();
    if (clearance_m > reach_m) return std::nullopt;
    return BeamIntersection{clearance_m, kObject_m};
  };
}

CoverBeam Covered(double fraction) {
  return [fraction](const BeamFootprints&, std::size_t) -> std::optional<BeamCoverage> {
    return BeamCoverage{fraction, kObject_m};
  };
}

double FractionAt(double edge_m, const BeamOptions& options, double footprint_height_rad = 0.0) {
  RaySet rays = Beams(kObject_m, 2);
  rays.footprint_height_rad = footprint_height_rad;
  const BeamFootprints footprints(rays, {}, options);
  const auto coverage = CoverBySamples(HalfSpaceAbove(edge_m))(footprints, 0);
  return coverage ? coverage->fraction : -1.0;
}

TEST(CoverBySamples, AnEdgeThroughTheMiddleIsHalfOfTheBeam) {
  BeamOptions options;
  options.early_return = 0.0;
  EXPECT_NEAR(FractionAt(0.0, options), 0.5, 1e-9);
  EXPECT_LT(FractionAt(0.005, options), 0.2);
  EXPECT_GT(FractionAt(-0.005, options), 0.8);
}

TEST(CoverBySamples, AQuarterOfTheFootprintIsHalfOfTheBeamsThatReturnEarly) {
  EXPECT_NEAR(FractionAt(0.0025, BeamOptions()), 0.5, 1e-9);
}

TEST(CoverBySamples, AnObjectOutOfReachCoversNothing) {
  EXPECT_LE(FractionAt(0.1, BeamOptions()), 0.0);
}

TEST(CoverBySamples, SamplesOfATallFootprintFadeOutOverItsHeight) {
  BeamOptions options;
  options.early_return = 0.0;
  options.samples = 3;
  constexpr double kHeight_rad = 0.018;  // 36 mm at 2 m: samples 12 mm apart
  EXPECT_NEAR(FractionAt(0.0, options, kHeight_rad), 0.5, 0.01);
  EXPECT_NEAR(FractionAt(0.012, options, kHeight_rad), 1.0 / 6.0, 0.02);
  options.samples = 1;
  EXPECT_LT(FractionAt(0.012, options, kHeight_rad), 0.02);
}

TEST(BeamFootprints, MixWithTheWallFromAThousandthOfThemOn) {
  BeamOptions options;
  options.mixed_ranges = true;
  const BeamFootprints footprints(Beams(kObject_m), {&kWall, 1}, options);
  EXPECT_FALSE(footprints.Expect(0, {0.0009, kObject_m}).mixed);
  const ExpectedBeam quarter = footprints.Expect(0, {0.25, kObject_m});
  EXPECT_TRUE(quarter.mixed);
  EXPECT_NEAR(quarter.range_m, 2.15, 1e-9);
  EXPECT_GT(quarter.sigma_m, footprints.Sigma());
  options.mixed_ranges = false;
  EXPECT_FALSE(
      BeamFootprints(Beams(kObject_m), {&kWall, 1}, options).Expect(0, {0.25, kObject_m}).mixed);
}

TEST(BeamFootprints, LookBehindOnlyWhereAskedTo) {
  BeamOptions options;
  options.mixed_ranges = true;
  const RaySet before_wall = Beams(2.1, 5);
  EXPECT_TRUE(BeamFootprints(before_wall, {&kWall, 1}, options).ReachesBackground(0));
  options.look_behind = true;
  EXPECT_FALSE(BeamFootprints(before_wall, {&kWall, 1}, options).ReachesBackground(0));
}

TEST(BeamFootprints, AgreeAsFarAsTheWallsRangesDo) {
  const auto agreement = [](double behind_m, int count) {
    RaySet rays = Beams(kWall_m, count);
    for (RangeRay& ray : rays.rays) ray.range_m = RangeToPlane(ray, kWall) + behind_m;
    const BeamFootprints footprints(rays, {&kWall, 1});
    return footprints.Agreement(footprints.Expect(0, {1.0, kObject_m})) / footprints.Sigma();
  };
  EXPECT_NEAR(agreement(0.001, 100), BeamModel::kAgreeSigmas, 1e-9);
  EXPECT_NEAR(agreement(0.1, 100), 2.5 * BeamModel::kAgreeSigmas, 1e-9)
      << "longer tails do not count";
  EXPECT_NEAR(agreement(0.1, 40), BeamModel::kAgreeSigmas, 1e-9) << "too few to tell";
}

TEST(BeamLikelihood, TheStrongerReturnIsThatOfTheLargerPart) {
  const auto ahead = [](double fraction, bool stronger) {
    BeamOptions options;
    options.stronger_return = stronger;
    const BeamLikelihood likelihood(Beams(kObject_m), {&kWall, 1}, options);
    return likelihood(Covered(fraction)) - likelihood.Nothing();
  };
  EXPECT_LT(ahead(0.1, true), ahead(0.1, false));
  EXPECT_GT(ahead(0.5, true), ahead(0.5, false));
  EXPECT_NEAR(ahead(1.0, true), ahead(1.0, false), 1e-12);
}

TEST(BeamLikelihood, WhatWasMeasuredIsBehindTheMap) {
  RaySet map = Beams(kObject_m, 20);
  const BeamLikelihood alone(map, {&kWall, 1});
  EXPECT_EQ(&alone.Measured(), &alone);
  map.beams = std::make_shared<const RaySet>(Beams(kObject_m, 4));
  const BeamLikelihood both(map, {&kWall, 1});
  EXPECT_EQ(&both.Measured(), both.BehindMap());
  EXPECT_EQ(both.Gains(Covered(1.0)).size(), 4);
  const double expected = BeamModel::kMapWithBeams * alone(Covered(1.0)) +
                          BeamLikelihood(*map.beams, {&kWall, 1})(Covered(1.0));
  EXPECT_NEAR(both(Covered(1.0)), expected, 1e-9);
}

}  // namespace
}  // namespace foresight
