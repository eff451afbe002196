// The table under what stands there: not a slice through it, not the floor before it, and of all
// that is known round a region.
#include "core/fitting/drill/find_tables.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "core/geometry/angles.h"

namespace foresight {
namespace {

const Eigen::Vector3d kUp = Eigen::Vector3d::UnitZ();

/// A post on a table over a floor, seen from the origin; x is forward.
struct TableView {
  double table_m = -0.5;  ///< z
  double floor_m = -1.2;
  double near_m = 1.0, far_m = 1.7;  ///< x of the table's edges
  double post_m = 1.25;              ///< x of the post's face, which is 0.2 m high
  double half_post_m = 0.05;         ///< half its width
  double sigma_m = 0.010;
  double low_deg = -40.0, high_deg = -8.0;  ///< of the lines
};

double RangeIn(const TableView& view, const Eigen::Vector3d& way) {
  const double post = view.post_m / way.x();
  if (std::abs(post * way.y()) < view.half_post_m && post * way.z() > view.table_m &&
      post * way.z() < view.table_m + 0.2)
    return post;
  if (way.z() >= 0.0) return 3.0;
  const double table = view.table_m / way.z();
  if (table * way.x() > view.near_m && table * way.x() < view.far_m) return table;
  return view.floor_m / way.z();
}

RaySet RaysOf(const TableView& view) {
  Random random(1);
  RaySet rays;
  rays.sigma_m = view.sigma_m;
  int line = 0;
  for (double up_deg = view.low_deg; up_deg < view.high_deg; up_deg += 0.4, ++line)
    for (int beam = -30; beam <= 30; ++beam) {
      const double up = RadiansFromDegrees(up_deg), side = RadiansFromDegrees(0.4 * beam);
      const Eigen::Vector3d way(std::cos(up) * std::cos(side), std::cos(up) * std::sin(side),
                                std::sin(up));
      rays.rays.push_back({Eigen::Vector3d::Zero(),
                           way,
                           RangeIn(view, way) + view.sigma_m * random.Normal(),
                           {beam, line}});
    }
  return rays;
}

/// Of the rays only those that end above the table.
RaySet PostAlone(RaySet rays, const TableView& view) {
  std::erase_if(rays.rays, [&](const RangeRay& ray) {
    const Eigen::Vector3d at = ray.Point();
    return std::abs(at.y()) > view.half_post_m || std::abs(at.x() - view.post_m) > 0.05 ||
           at.z() < view.table_m + 0.01;
  });
  return rays;
}

std::vector<Plane> TablesIn(const RaySet& region) {
  Random random(1);
  return FindTables(region, region.rays, {.up = kUp}, random);
}

void ExpectTable(const std::vector<Plane>& tables, const TableView& view, double within_m,
                 double within_deg) {
  ASSERT_FALSE(tables.empty());
  const Plane& table = tables.front();
  EXPECT_NEAR(table.Distance({view.post_m, 0.0, view.table_m}), 0.0, within_m);
  EXPECT_LT(DegreesFromRadians(std::acos(std::min(1.0, table.normal.dot(kUp)))), within_deg);
}

TEST(FindTables, FindsTheTableAndTheFloorBelow) {
  const TableView view;
  const std::vector<Plane> tables = TablesIn(RaysOf(view));
  ExpectTable(tables, view, 0.003, 0.5);
  EXPECT_EQ(tables.size(), 2u);
}

TEST(FindTables, NoiseAlongGrazingBeamsDoesNotTiltTheTable) {
  TableView view;
  view.table_m = -0.18;
  view.sigma_m = 0.025;
  view.low_deg = -12.0;
  view.high_deg = 4.0;
  ExpectTable(TablesIn(RaysOf(view)), view, 0.005, 1.5);
}

TEST(FindTables, ASliceThroughWhatStandsThereIsNone) {
  for (const double sigma_m : {0.005, 0.010, 0.025}) {
    TableView view;
    view.sigma_m = sigma_m;
    EXPECT_TRUE(TablesIn(PostAlone(RaysOf(view), view)).empty()) << sigma_m;
  }
}

TEST(FindTables, OfAWideThingAloneOnlyTheFootMayPassForATable) {
  for (const double sigma_m : {0.005, 0.010, 0.025}) {
    TableView view;
    view.half_post_m = 0.15;
    view.sigma_m = sigma_m;
    for (const Plane& table : TablesIn(PostAlone(RaysOf(view), view)))
      EXPECT_NEAR(table.Distance({view.post_m, 0.0, view.table_m}), 0.0, 0.04) << sigma_m;
  }
}

TEST(FindTables, AShelfAboveIsNone) {
  TableView view;
  RaySet region = PostAlone(RaysOf(view), view);
  RaySet around = RaysOf(view);
  TableView shelf = view;
  shelf.table_m = -0.2;
  shelf.half_post_m = 0.0;
  for (const RangeRay& ray : RaysOf(shelf).rays)
    if (std::abs(ray.Point().z() - shelf.table_m) < 0.02) around.rays.push_back(ray);
  region.around = std::make_shared<const RaySet>(std::move(around));
  ExpectTable(TablesIn(region), view, 0.003, 0.5);
}

TEST(FindTables, WhatLiesRoundTheRegionShowsTheTable) {
  const TableView view;
  RaySet region = PostAlone(RaysOf(view), view);
  region.around = std::make_shared<const RaySet>(RaysOf(view));
  ExpectTable(TablesIn(region), view, 0.003, 0.5);
}

TEST(FindTables, TheFloorBeforeATableIsNone) {
  TableView view;
  view.near_m = 1.12;
  view.far_m = 1.9;
  view.floor_m = -0.68;
  RaySet region = RaysOf(view);
  std::erase_if(region.rays, [](const RangeRay& ray) {
    const double up_deg = DegreesFromRadians(std::asin(ray.direction.z()));
    return std::abs(ray.Point().y()) > 0.15 || ray.Point().x() > 1.6 || up_deg < -28.0;
  });
  region.around = std::make_shared<const RaySet>(RaysOf(view));
  ExpectTable(TablesIn(region), view, 0.004, 1.0);
}

TEST(FindTables, NothingIsSeenWhereNothingIs) {
  const TableView view;
  RaySet region = PostAlone(RaysOf(view), view);
  region.around = std::make_shared<const RaySet>(region);
  EXPECT_TRUE(TablesIn(region).empty());
  region.rays.clear();
  EXPECT_TRUE(TablesIn(region).empty());
}

}  // namespace
}  // namespace foresight
