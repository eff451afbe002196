#include "core/fitting/beam_footprints.h"

#include <gtest/gtest.h>

#include "core/fitting/valve/valve_coverage.h"

namespace foresight {
namespace {

/// Two beams of one scan line from the origin, their footprint 10 mm along the line and 24 mm
/// across it at 2 m; two more that end on a wall 150 mm behind.
class BeamFootprintsAtTwoMetres : public ::testing::Test {
 protected:
  BeamFootprintsAtTwoMetres() {
    rays_.footprint_rad = 0.005;
    rays_.footprint_height_rad = 0.012;
    for (int beam = 0; beam < 4; ++beam)
      rays_.rays.push_back({Eigen::Vector3d::Zero(),
                            Eigen::Vector3d(0.004 * beam, 0.0, 1.0).normalized(),
                            beam < 2 ? 2.0 : 2.15,
                            {beam, 0}});
  }

  /// A tube that the first ray intersects at 2 m.
  static ValveIntersection Tube(double radius_m, double offset_m, const Eigen::Vector3d& across) {
    ValveIntersection intersection;
    intersection.middle_m = 2.0;
    intersection.radius_m = intersection.depth_m = radius_m;
    intersection.offset_m = offset_m;
    intersection.across = across;
    return intersection;
  }

  static ExpectedBeam Expected(const BeamFootprints& footprints,
                               const ValveIntersection& intersection, double brightness) {
    return footprints.Expect(0, CoverageOf(footprints, 0, intersection, brightness));
  }

  RaySet rays_;
  const Plane wall_{-Eigen::Vector3d::UnitZ(), -2.15};
};

TEST_F(BeamFootprintsAtTwoMetres, AreTallerThanWide) {
  const BeamFootprints footprints = ValveFootprints(rays_, wall_);
  EXPECT_NEAR(footprints.HalfWidthAlong(0, Eigen::Vector3d::UnitX()), 0.005, 0.001);
  EXPECT_NEAR(footprints.HalfWidthAlong(0, Eigen::Vector3d::UnitY()), 0.012, 0.001);
  EXPECT_NEAR(footprints.BackgroundRange(0), 2.15, 1e-9);
}

TEST_F(BeamFootprintsAtTwoMetres, OnAThickTubeReadItsFront) {
  const ExpectedBeam expected =
      Expected(ValveFootprints(rays_, wall_), Tube(0.05, 0.0, Eigen::Vector3d::UnitY()), 1.0);
  EXPECT_EQ(expected.fraction, 1.0);
  EXPECT_NEAR(expected.range_m, 1.95, 0.001);
}

TEST_F(BeamFootprintsAtTwoMetres, OnAFlatBarReadItsFrontWhichLeansWithIt) {
  ValveIntersection bar = Tube(0.05, 0.02, Eigen::Vector3d::UnitX());
  bar.depth_m = 0.01;
  bar.lean = -0.5;  // 10 mm nearer where the ray passes, 20 mm beside the middle
  const ExpectedBeam expected = Expected(ValveFootprints(rays_, wall_), bar, 1.0);
  EXPECT_EQ(expected.fraction, 1.0);
  EXPECT_NEAR(expected.range_m, 1.981, 0.001);
}

TEST_F(BeamFootprintsAtTwoMetres, OnAThinTubeReadBetweenItAndTheWall) {
  const ExpectedBeam expected =
      Expected(ValveFootprints(rays_, wall_), Tube(0.006, 0.0, Eigen::Vector3d::UnitY()), 1.0);
  EXPECT_NEAR(expected.fraction, 0.5, 0.03);
  EXPECT_NEAR(expected.range_m, 2.0 + 0.075, 0.010);
  // Nobody knows exactly how much of the footprint is on it.
  EXPECT_GT(expected.sigma_m, 1.5 * ValveFootprints(rays_, wall_).Sigma());
}

TEST_F(BeamFootprintsAtTwoMetres, ReadNearerToTheBrighterSurface) {
  const BeamFootprints footprints = ValveFootprints(rays_, wall_);
  const ValveIntersection tube = Tube(0.006, 0.0, Eigen::Vector3d::UnitY());
  EXPECT_LT(Expected(footprints, tube, 3.0).range_m,
            Expected(footprints, tube, 1.0).range_m - 0.02);
}

TEST_F(BeamFootprintsAtTwoMetres, DoNotMixWithTheWallWhereABodyIsBeforeIt) {
  for (RangeRay& ray : rays_.rays)
    if (ray.range_m > 2.1) ray.range_m = 2.07;
  const BeamFootprints footprints = ValveFootprints(rays_, wall_);
  EXPECT_FALSE(footprints.ReachesBackground(0));
  const ExpectedBeam expected =
      Expected(footprints, Tube(0.006, 0.0, Eigen::Vector3d::UnitY()), 1.0);
  EXPECT_FALSE(expected.mixed);
  EXPECT_NEAR(expected.range_m, expected.object_m, 1e-12);
}

TEST_F(BeamFootprintsAtTwoMetres, BesideATubeHaveNoPartInIt) {
  const ExpectedBeam expected =
      Expected(ValveFootprints(rays_, wall_), Tube(0.01, 0.03, Eigen::Vector3d::UnitX()), 1.0);
  EXPECT_EQ(expected.fraction, 0.0);
}

TEST_F(BeamFootprintsAtTwoMetres, DoNotMixWithoutAWall) {
  const ExpectedBeam expected = Expected(ValveFootprints(rays_, std::nullopt),
                                         Tube(0.006, 0.0, Eigen::Vector3d::UnitY()), 1.0);
  EXPECT_FALSE(expected.mixed);
  EXPECT_LT(expected.range_m, 2.0);
}

}  // namespace
}  // namespace foresight
