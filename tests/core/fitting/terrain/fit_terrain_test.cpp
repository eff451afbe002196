#include "core/fitting/terrain/fit_terrain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/core/fitting/terrain/terrain_rays.h"

namespace foresight {
namespace {

using samples::Ground;
using samples::RaysOnto;
using samples::Slab;
using samples::SlabAt;
using Kind = TerrainSurface::Kind;

constexpr double kStep_deg = 0.4;
constexpr double kSigma_m = 0.006;
const Eigen::Vector2d kBlock(0.397, 0.390);

TerrainDetection Fit(const std::vector<Slab>& slabs, std::uint64_t seed = 1) {
  const auto found = FitTerrain(RaysOnto(slabs, kStep_deg, kSigma_m, seed), {}, {});
  EXPECT_TRUE(found) << found.error().message;
  return found ? *found : TerrainDetection();
}

int Count(const TerrainDetection& detection, Kind kind) {
  return static_cast<int>(
      std::count_if(detection.surfaces.begin(), detection.surfaces.end(),
                    [kind](const auto& surface) { return surface.kind == kind; }));
}

/// A field of one tilted block on the ground, 1.4 m below the viewer.
std::vector<Slab> OneBlock(double right = 0.1, double ahead = 1.5, double turn_deg = 10.0) {
  return {Ground(1.4), SlabAt(right, 1.2, ahead, kBlock, 12.0, 0.0, turn_deg)};
}

/// Rows of three that rise away from the viewer, on the ground.
std::vector<Slab> FieldOf(const Eigen::Vector2d& size_m, int rows, double pitch_m, double ahead_m) {
  std::vector<Slab> slabs = {Ground(1.4)};
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < 3; ++column)
      slabs.push_back(SlabAt(pitch_m * (column - 1), 1.2 - 0.1 * row, ahead_m + pitch_m * row,
                             size_m, (row + column) % 2 == 0 ? 14.0 : -8.0));
  return slabs;
}

TEST(FitTerrain, FindsATiltedBlockAndItsPose) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const TerrainDetection found = Fit(OneBlock(), seed);
    ASSERT_EQ(Count(found, Kind::kBlock), 1);
    const TerrainSurface& block = found.surfaces.front();
    const auto error = OneBlock()[1].base_from_slab.Inverse() * block.base_from_object;
    EXPECT_LT(error.translation().norm(), 0.010) << "seed " << seed;
    EXPECT_GT(error.Rotate(Eigen::Vector3d::UnitZ()).z(), std::cos(RadiansFromDegrees(1.0)));
    EXPECT_NEAR(block.toehold.slope_rad, RadiansFromDegrees(12.0), RadiansFromDegrees(1.0));
    EXPECT_NEAR(block.toehold.size_m.x(), 0.357, 1e-9);
  }
}

TEST(FitTerrain, AFewBeamsThatReadSomethingFarBehindTakeNoBlockAway) {
  RaySet rays = RaysOnto(OneBlock(), kStep_deg, kSigma_m, 1);
  for (std::size_t i = 0; i < rays.rays.size(); i += 25) rays.rays[i].range_m = 9.0;
  const auto found = FitTerrain(rays, {}, {});
  ASSERT_TRUE(found);
  ASSERT_EQ(Count(*found, Kind::kBlock), 1);
  EXPECT_LT(found->surfaces.front().evidence.see_through, 0.10);  // 4 %, wherever they end
}

TEST(FitTerrain, BlocksInRowsArePlacedByTheirNeighborsToo) {
  const std::vector<Slab> slabs = FieldOf(kBlock, 3, 0.43, 1.2);
  FitTerrainOptions alone;
  alone.place_together = false;
  const auto mean_error_m = [&](const FitTerrainOptions& options) {
    double sum = 0.0;
    int blocks = 0;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const auto found = FitTerrain(RaysOnto(slabs, 0.6, 0.015, seed), options, {});
      EXPECT_TRUE(found) << found.error().message;
      if (!found) continue;
      for (const TerrainSurface& surface : found->surfaces) {
        double least = 0.05;
        for (const Slab& slab : slabs)
          least = std::min(
              least,
              (slab.base_from_slab.translation() - surface.base_from_object.translation()).norm());
        if (surface.kind != Kind::kBlock || least >= 0.05) continue;
        sum += least;
        ++blocks;
      }
    }
    EXPECT_GE(blocks, 24);
    return sum / blocks;
  };
  EXPECT_LT(mean_error_m({}), 0.8 * mean_error_m(alone));
}

// The first surface is the pose that is offered first.
TEST(FitTerrain, BlocksThatAreOfferedComeBeforeThoseThatAreUnsure) {
  int unsure_and_nearer = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const RaySet rays = RaysOnto(FieldOf(kBlock, 3, 0.43, 1.2), 0.6, 0.015, seed);
    const auto found = FitTerrain(rays, {}, {});
    ASSERT_TRUE(found) << found.error().message;
    const auto distance_m = [&](const TerrainSurface& surface) {
      return (surface.base_from_object.translation() - rays.viewpoint).norm();
    };
    double farthest_offered_m = 0.0;
    bool unsure_came = false;
    for (const TerrainSurface& surface : found->surfaces) {
      if (surface.kind != Kind::kBlock) break;
      const bool unsure = surface.verdict.level == VerdictLevel::kUnsure;
      EXPECT_TRUE(unsure || !unsure_came);
      unsure_came = unsure_came || unsure;
      if (unsure)
        unsure_and_nearer += distance_m(surface) < farthest_offered_m;
      else
        farthest_offered_m = std::max(farthest_offered_m, distance_m(surface));
    }
  }
  EXPECT_GT(unsure_and_nearer, 0) << "by distance alone the order would be the same";
}

TEST(FitTerrain, GroundIsGroundAndNoFoothold) {
  const TerrainDetection found = Fit({Ground(1.4)});
  EXPECT_EQ(Count(found, Kind::kBlock), 0);
  EXPECT_GE(Count(found, Kind::kGround), 1);
  EXPECT_EQ(found.verdict.level, VerdictLevel::kUnsure);
  for (const TerrainSurface& surface : found.surfaces)
    EXPECT_EQ(surface.toehold.size_m.norm(), 0.0);
}

TEST(FitTerrain, ASmallBoxIsKeptAsUnknown) {
  const TerrainDetection found = Fit({Ground(1.4), SlabAt(0.0, 1.15, 1.5, {0.22, 0.20})});
  EXPECT_EQ(Count(found, Kind::kBlock), 0);
  EXPECT_EQ(Count(found, Kind::kUnknown), 1);
}

TEST(FitTerrain, CoplanarNeighborsAreTwoBlocks) {
  const TerrainDetection found =
      Fit({Ground(1.4), SlabAt(-0.20, 1.2, 1.5, kBlock), SlabAt(0.20, 1.2, 1.5, kBlock)});
  ASSERT_EQ(Count(found, Kind::kBlock), 2);
  const double left = std::min(found.surfaces[0].base_from_object.translation().x(),
                               found.surfaces[1].base_from_object.translation().x());
  const double right = std::max(found.surfaces[0].base_from_object.translation().x(),
                                found.surfaces[1].base_from_object.translation().x());
  EXPECT_NEAR(left, -0.20, 0.02);
  EXPECT_NEAR(right, 0.20, 0.02);
}

TEST(FitTerrain, CartonsOfNearlyABlocksSizeAreNotConfirmed) {
  const auto of_another_size = [](const TerrainSurface& surface) {
    const auto& failed = surface.verdict.failed_gates;
    return surface.kind == Kind::kBlock &&
           std::any_of(failed.begin(), failed.end(), [](const std::string& why) {
             return why.starts_with("the odds that it has a block's size");
           });
  };
  const auto count = [&](const Eigen::Vector2d& size_m) {
    const TerrainDetection found = Fit(FieldOf(size_m, 2, 0.52, 1.3));
    return std::count_if(found.surfaces.begin(), found.surfaces.end(), of_another_size);
  };
  EXPECT_EQ(count(kBlock), 0);
  EXPECT_EQ(count({0.45, 0.390}), 6);
  EXPECT_EQ(count({0.397, 0.33}), 6);
}

TEST(FitTerrain, EveryRayKnowsItsSurface) {
  const RaySet rays = RaysOnto(OneBlock(), kStep_deg, kSigma_m, 1);
  const auto found = FitTerrain(rays, {}, {});
  ASSERT_TRUE(found);
  ASSERT_EQ(found->labels.size(), rays.rays.size());
  const auto of_block = std::count(found->labels.begin(), found->labels.end(), 0);
  EXPECT_GT(of_block, found->surfaces.front().evidence.points * 9 / 10);
  EXPECT_LT(*std::max_element(found->labels.begin(), found->labels.end()),
            static_cast<int>(found->surfaces.size()));
}

FitTerrainOptions Since(const TerrainDetection& last) {
  FitTerrainOptions options;
  options.last = std::make_shared<const TerrainDetection>(last);
  return options;
}

TEST(FitTerrain, AShiftedBlockIsMarkedWithItsShift) {
  const TerrainDetection before = Fit(OneBlock(0.10, 1.5, 10.0));
  const auto after =
      FitTerrain(RaysOnto(OneBlock(0.16, 1.5, 16.0), kStep_deg, kSigma_m, 2), Since(before), {});
  ASSERT_TRUE(after);
  ASSERT_EQ(Count(*after, Kind::kBlock), 1);
  EXPECT_NEAR(after->surfaces.front().shift_m, 0.06, 0.012);
  EXPECT_NEAR(after->surfaces.front().turn_rad, RadiansFromDegrees(6.0), RadiansFromDegrees(1.5));
}

TEST(FitTerrain, ABlockThatWasNotThereBeforeHasNoShift) {
  const TerrainDetection before = Fit({Ground(1.4)});
  const auto after = FitTerrain(RaysOnto(OneBlock(), kStep_deg, kSigma_m, 2), Since(before), {});
  ASSERT_TRUE(after);
  EXPECT_TRUE(std::isnan(after->surfaces.front().shift_m));
}

TEST(FitTerrain, StepsAreHeightsAboveTheNeighborOrTheGround) {
  const TerrainDetection alone = Fit(OneBlock());
  EXPECT_NEAR(alone.surfaces.front().toehold.step_m, 0.2, 0.01);
  const TerrainDetection two =
      Fit({Ground(1.4), SlabAt(-0.25, 1.2, 1.5, kBlock), SlabAt(0.25, 1.1, 1.5, kBlock)});
  ASSERT_EQ(Count(two, Kind::kBlock), 2);
  EXPECT_NEAR(std::abs(two.surfaces.front().toehold.step_m), 0.1, 0.01);
}

TEST(FitTerrain, TooFewOrUnusableRaysAreAnError) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const int count : {0, 3, 500}) {
    RaySet rays;
    rays.rays.assign(static_cast<std::size_t>(count),
                     {Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ(), count < 10 ? 1.0 : nan});
    const auto found = FitTerrain(rays, {}, {});
    ASSERT_FALSE(found);
    EXPECT_EQ(found.error().code, ErrorCode::kTooFewPoints);
  }
}

TEST(FitTerrain, OneScanLineIsNoTerrain) {
  RaySet rays = RaysOnto(OneBlock(), kStep_deg, kSigma_m, 1);
  std::erase_if(rays.rays, [](const RangeRay& ray) { return ray.cell.y() != 60; });
  ASSERT_GT(rays.rays.size(), 100u);
  const auto found = FitTerrain(rays, {}, {});
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::kNoConvergence) << found.error().message;
}

TEST(FitTerrain, AHeadBelievedUpsideDownSeesNoTerrain) {
  FitTerrainOptions options;
  options.up = Eigen::Vector3d::UnitY();
  const auto found = FitTerrain(RaysOnto(OneBlock(), kStep_deg, kSigma_m, 1), options, {});
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::kNoConvergence) << found.error().message;
}

TEST(FitTerrain, PointsBehindTheScannerAreNoTerrain) {
  RaySet rays = RaysOnto(OneBlock(), kStep_deg, kSigma_m, 1);
  for (RangeRay& ray : rays.rays) ray.direction = -ray.direction;
  const auto found = FitTerrain(rays, {}, {});
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::kNoConvergence) << found.error().message;
}

TEST(FitTerrain, ACloudWithoutAGridGivesTheSameBlock) {
  RaySet rays = RaysOnto(OneBlock(), kStep_deg, kSigma_m, 1);
  for (RangeRay& ray : rays.rays) ray.cell.setConstant(-1);
  const auto found = FitTerrain(rays, {}, {});
  ASSERT_TRUE(found) << found.error().message;
  ASSERT_EQ(Count(*found, Kind::kBlock), 1);
  const auto error =
      OneBlock()[1].base_from_slab.Inverse() * found->surfaces.front().base_from_object;
  EXPECT_LT(error.translation().norm(), 0.015);
}

TEST(FitTerrain, IsTheSameOnAnyNumberOfThreads) {
  const RaySet rays = RaysOnto(OneBlock(), kStep_deg, kSigma_m, 1);
  RunContext one, four;
  one.threads = 1;
  four.threads = 4;
  const auto a = FitTerrain(rays, {}, one);
  const auto b = FitTerrain(rays, {}, four);
  ASSERT_TRUE(a && b);
  ASSERT_EQ(a->surfaces.size(), b->surfaces.size());
  EXPECT_EQ(a->labels, b->labels);
  for (std::size_t i = 0; i < a->surfaces.size(); ++i)
    EXPECT_TRUE(a->surfaces[i].base_from_object.Matrix() ==
                b->surfaces[i].base_from_object.Matrix());
}

TEST(FitTerrain, StopsWhenAsked) {
  std::stop_source stop;
  stop.request_stop();
  RunContext context;
  context.stop = stop.get_token();
  const auto found = FitTerrain(RaysOnto(OneBlock(), kStep_deg, kSigma_m, 1), {}, context);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::kCancelled);
}

TEST(FitTerrain, ReportsItsProgressToTheEnd) {
  Progress progress;
  RunContext context;
  context.progress = &progress;
  ASSERT_TRUE(FitTerrain(RaysOnto(OneBlock(), kStep_deg, kSigma_m, 1), {}, context));
  EXPECT_EQ(progress.permille.load(), 1000);
}

TEST(FitTerrain, RefusesABlockWithoutSize) {
  FitTerrainOptions options;
  options.block_size_m = {0.4, 0.0};
  const auto found = FitTerrain({}, options, {});
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::kInvalidOptions);
}

}  // namespace
}  // namespace foresight
