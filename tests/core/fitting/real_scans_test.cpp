// Fits on scans of the real world: a lamp post, rooms, a street, a stair. There is no valve and no
// drill in any of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <string>

#include "core/fitting/cylinder/fit_cylinder.h"
#include "core/fitting/drill/fit_drill.h"
#include "core/fitting/terrain/fit_terrain.h"
#include "core/fitting/valve/fit_valve.h"
#include "core/io/read_point_cloud.h"

namespace foresight {
namespace {

using Points = std::vector<Eigen::Vector3d>;

std::filesystem::path DataFile(const std::string& name) {
  return std::filesystem::path(FORESIGHT_TEST_DATA) / "scans" / name;
}

#define SKIP_WITHOUT(file)                      \
  if (!std::filesystem::exists(DataFile(file))) \
  GTEST_SKIP() << "needs FORESIGHT_TEST_DATA: " << DataFile(file)

/// As 3DTK writes them: x y z, a point a line, in centimetres, left-handed with y up.
Points Read3dtkPoints(const std::filesystem::path& path) {
  std::ifstream stream(path);
  Points points;
  for (Eigen::Vector3d p; stream >> p.x() >> p.y() >> p.z();)
    points.push_back(0.01 * Eigen::Vector3d(p.x(), p.y(), -p.z()));
  return points;
}

Points PointsOf(const std::string& name) {
  if (name.ends_with(".3d")) return Read3dtkPoints(DataFile(name));
  const auto points = ReadPointCloud(DataFile(name));
  EXPECT_TRUE(points) << points.error().message;
  return points.value_or(Points());
}

BoxRoi BoxAt(const Eigen::Vector3d& middle, const Eigen::Vector3d& size_m) {
  return {{Eigen::Quaterniond::Identity(), middle}, size_m};
}

TEST(RealScan, ALampPostOfAStreetIsACylinderOfItsRadius) {
  SKIP_WITHOUT("kitti_000007/000007.bin");
  const Points points = PointsOf("kitti_000007/000007.bin");
  // Tight, wide with the ground in it, and only a part of the post.
  const std::array boxes = {BoxAt({7.25, -4.70, -0.4}, {0.8, 0.8, 1.7}),
                            BoxAt({7.25, -4.70, -0.5}, {1.6, 1.6, 2.4}),
                            BoxAt({7.25, -4.70, -0.2}, {0.6, 0.6, 1.2})};
  for (const BoxRoi& box : boxes) {
    const auto rays =
        RaysFromCloud(points, Eigen::Vector3d::Zero(), nullptr, box, 0.02, BoxRays::kPassThrough);
    ASSERT_TRUE(rays) << rays.error().message;
    FitCylinderOptions options;
    options.up = Eigen::Vector3d::UnitZ();
    const auto post = FitCylinder(*rays, options, {});
    ASSERT_TRUE(post) << post.error().message;
    EXPECT_NEAR(post->model.radius_m, 0.223, 0.020) << box.size_m.transpose();
    EXPECT_EQ(post->verdict.level, VerdictLevel::kLikely) << post->verdict.reason;
    const Eigen::Vector3d axis = post->base_from_object.Rotate(Eigen::Vector3d::UnitZ());
    EXPECT_GT(axis.z(), 0.995);
    EXPECT_LT(
        (post->base_from_object.translation() - Eigen::Vector3d(7.25, -4.70, 0.0)).head<2>().norm(),
        0.06);
    EXPECT_LT(post->evidence.residual_mad_m, 0.030);
    std::cout << "radius " << 1000.0 * post->model.radius_m << " +- "
              << 1000.0 * post->sigma_radius_m << " mm, median residual "
              << 1000.0 * post->evidence.residual_mad_m << " mm, box margin "
              << post->evidence.box_margin_nats << " nats\n";
  }
}

struct RealScan {
  std::string file;
  Eigen::Vector3d up;
  double reach_m;  ///< boxes no further than this
};

constexpr double kCell_m = 0.7;
constexpr int kLeastPoints = 120;
constexpr std::size_t kPlaces = 16;

/// The cells of a grid that hold enough to look at, evenly chosen.
std::vector<Eigen::Vector3d> OccupiedPlaces(const Points& points, double reach_m) {
  std::map<std::array<int, 3>, int> counts;
  for (const Eigen::Vector3d& point : points) {
    if (!point.allFinite() || point.norm() > reach_m || point.norm() < 0.5) continue;
    const Eigen::Vector3i cell = (point / kCell_m).array().round().cast<int>();
    ++counts[{cell.x(), cell.y(), cell.z()}];
  }
  std::erase_if(counts, [](const auto& entry) { return entry.second < kLeastPoints; });
  std::vector<Eigen::Vector3d> places;
  const std::size_t step = std::max<std::size_t>(1, counts.size() / kPlaces);
  std::size_t i = 0;
  for (const auto& [cell, count] : counts)
    if (i++ % step == 0 && places.size() < kPlaces)
      places.push_back(kCell_m * Eigen::Vector3d(cell[0], cell[1], cell[2]));
  return places;
}

// The stair, which takes longer than the others together, by night.
class EveryPlaceOfARealScan : public ::testing::TestWithParam<RealScan> {};

TEST_P(EveryPlaceOfARealScan, IsNotConfirmedAsAValveOrADrill) {
  const RealScan& scan = GetParam();
  SKIP_WITHOUT(scan.file);
  const Points points = PointsOf(scan.file);
  int asked = 0, valves = 0, drills = 0;
  double valve = 0.0, drill = 0.0;
  for (const Eigen::Vector3d& place : OccupiedPlaces(points, scan.reach_m)) {
    const auto rays = RaysFromCloud(points, Eigen::Vector3d::Zero(), nullptr,
                                    BoxAt(place, Eigen::Vector3d::Constant(kCell_m)), 0.010);
    ASSERT_TRUE(rays) << rays.error().message;
    asked += 2;
    if (const auto found = FitValve(*rays, {}, {})) {
      ++valves;
      valve = std::max(valve, found->verdict.probability);
      EXPECT_NE(found->verdict.level, VerdictLevel::kConfirmed) << place.transpose();
    }
    FitDrillOptions options;
    options.up = scan.up;
    if (const auto found = FitDrill(*rays, options, {})) {
      ++drills;
      drill = std::max(drill, found->verdict.probability);
      EXPECT_NE(found->verdict.level, VerdictLevel::kConfirmed) << place.transpose();
    }
  }
  EXPECT_GE(asked, 30);
  // An error confirms nothing either, but tells nothing of the verdicts.
  EXPECT_GE(valves, 5);
  EXPECT_GE(drills, 4);
  std::cout << asked << " fits, " << valves << " valves, " << drills
            << " drills; most probable valve " << valve << ", drill " << drill << "\n";
}

INSTANTIATE_TEST_SUITE_P(
    Scans, EveryPlaceOfARealScan,
    ::testing::Values(RealScan{"kitti_000007/000007.bin", Eigen::Vector3d::UnitZ(), 12.0},
                      RealScan{"room_scan/room_scan1.pcd", Eigen::Vector3d::UnitZ(), 12.0},
                      RealScan{"3dtk_sick/scan000.3d", Eigen::Vector3d::UnitY(), 12.0},
                      RealScan{"stairs_kinect2/0001_cloud.pcd", -Eigen::Vector3d::UnitY(), 6.0}),
    [](const auto& scan) {
      std::string name = scan.param.file;
      std::replace_if(
          name.begin(), name.end(), [](char c) { return std::isalnum(c) == 0; }, '_');
      return name;
    });

/// The Kinect's cloud as the rays of its pixels; its frame is that of a camera, as base is.
RaySet RaysOfKinect(const Points& points, int width) {
  RaySet set;
  set.sigma_m = 0.006;
  set.footprint_rad = 1.0 / 365.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double range = points[i].norm();
    if (!points[i].allFinite() || !(range > 0.3 && range < 4.0)) continue;
    set.rays.push_back({Eigen::Vector3d::Zero(),
                        points[i] / range,
                        range,
                        {static_cast<int>(i) % width, static_cast<int>(i) / width}});
  }
  return set;
}

Eigen::Vector3d NormalOf(const TerrainSurface& surface) {
  return surface.base_from_object.Rotate(Eigen::Vector3d::UnitZ());
}

/// The normal of all that is level: treads tilt by a degree or two against each other, and a
/// height taken along one of them alone takes that for a rise.
Eigen::Vector3d LevelNormal(const TerrainDetection& found) {
  const auto points = [](const TerrainSurface& surface) { return surface.evidence.points; };
  const Eigen::Vector3d largest = NormalOf(*std::ranges::max_element(found.surfaces, {}, points));
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const TerrainSurface& surface : found.surfaces)
    if (NormalOf(surface).dot(largest) > std::cos(0.09) && points(surface) > 100 &&
        surface.base_from_object.translation().norm() < 1.6)
      sum += NormalOf(surface);
  return sum.normalized();
}

/// Heights of the surfaces that are level, large enough to step on and near, lowest first; those
/// within 30 mm of each other as one.
std::vector<double> LevelHeights(const TerrainDetection& found, const Eigen::Vector3d& level) {
  std::vector<double> heights;
  for (const TerrainSurface& surface : found.surfaces) {
    const Eigen::Vector3d at = surface.base_from_object.translation();
    const bool is_level =
        surface.base_from_object.Rotate(Eigen::Vector3d::UnitZ()).dot(level) > std::cos(0.09);
    if (is_level && surface.evidence.points > 100 && surface.size_m.minCoeff() > 0.2 &&
        at.norm() < 1.6)
      heights.push_back(level.dot(at));
  }
  std::sort(heights.begin(), heights.end());
  const auto same = [](double a, double b) { return b - a < 0.030; };
  heights.erase(std::unique(heights.begin(), heights.end(), same), heights.end());
  return heights;
}

TEST(RealScan, TheTreadsOfAStairAreLevelPlanesOneRiseApart) {
  SKIP_WITHOUT("stairs_kinect2/0001_cloud.pcd");
  const RaySet rays = RaysOfKinect(PointsOf("stairs_kinect2/0001_cloud.pcd"), 512);
  FitTerrainOptions options;
  options.up = -Eigen::Vector3d::UnitX();  // the camera lay on its side
  const auto found = FitTerrain(rays, options, {});
  ASSERT_TRUE(found) << found.error().message;
  const Eigen::Vector3d level = LevelNormal(*found);
  const std::vector<double> heights = LevelHeights(*found, level);
  ASSERT_GE(heights.size(), 4U) << "the floor and three treads";
  std::vector<double> rises;
  for (std::size_t i = 1; i < heights.size(); ++i) rises.push_back(heights[i] - heights[i - 1]);
  const auto [least, most] = std::minmax_element(rises.begin(), rises.end());
  EXPECT_LE(*most - *least, 0.015);
  EXPECT_GT(*least, 0.070);
  EXPECT_LT(*most, 0.110);
  for (const TerrainSurface& surface : found->surfaces)
    EXPECT_NE(surface.verdict.level, VerdictLevel::kConfirmed);
  for (const double height : heights) std::cout << 1000.0 * height << " ";
  std::cout << rises.size() << " rises, " << 1000.0 * *least << " to " << 1000.0 * *most << " mm\n";
}

}  // namespace
}  // namespace foresight
