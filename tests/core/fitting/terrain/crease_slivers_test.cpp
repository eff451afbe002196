#include "core/fitting/terrain/crease_slivers.h"

#include <gtest/gtest.h>

#include <functional>

#include "core/fitting/terrain/block_rectangle.h"
#include "tests/core/fitting/terrain/terrain_rays.h"

namespace foresight {
namespace {

using samples::RaysOnto;
using samples::Slab;
using samples::SlabAt;

constexpr double kMinArea_m2 = 0.01;

/// Planes fitted to points that are labelled by where they lie.
SurfacePlanes Labelled(const SurfaceGrid& grid, int planes,
                       const std::function<int(const Eigen::Vector3d&)>& label) {
  SurfacePlanes surfaces;
  surfaces.planes.resize(static_cast<std::size_t>(planes));
  for (const GridPoint& point : grid.points()) surfaces.labels.push_back(label(point.point));
  RefitPlanes(grid, kMinArea_m2, surfaces);
  return surfaces;
}

/// Two slopes of 15 deg that rise to a ridge in the middle.
std::vector<Slab> Ridge() {
  return {SlabAt(-0.2415, 1.0647, 1.2, {0.5, 0.5}, 0.0, -15.0),
          SlabAt(0.2415, 1.0647, 1.2, {0.5, 0.5}, 0.0, 15.0)};
}

TEST(CreaseSlivers, AStripAlongARidgeIsNoPlaneOfItsOwn) {
  const SurfaceGrid grid(RaysOnto(Ridge(), 0.4, 0.001, 3), 62000);
  SurfacePlanes surfaces = Labelled(grid, 3, [](const Eigen::Vector3d& at) {
    return std::abs(at.x()) < 0.03 ? 2 : at.x() < 0.0 ? 0 : 1;
  });
  ASSERT_EQ(surfaces.planes.size(), 3u);
  DissolveCreaseSlivers(grid, kMinArea_m2, surfaces);
  EXPECT_EQ(surfaces.planes.size(), 2u);
  for (int i = 0; i < grid.size(); ++i)
    EXPECT_EQ(surfaces.labels[static_cast<std::size_t>(i)] < 0, std::abs(grid[i].point.x()) < 0.03);
}

TEST(CreaseSlivers, ASmallTopAboveALargeOneStays) {
  const SurfaceGrid grid(
      RaysOnto({SlabAt(0.0, 1.0, 1.2, {1.0, 1.0}), SlabAt(0.0, 0.9, 1.2, {0.2, 0.2})}, 0.4, 0.001,
               4),
      62000);
  SurfacePlanes surfaces =
      Labelled(grid, 2, [](const Eigen::Vector3d& at) { return at.y() < 0.95 ? 1 : 0; });
  const std::vector<int> before = surfaces.labels;
  ASSERT_EQ(surfaces.planes.size(), 2u);
  DissolveCreaseSlivers(grid, kMinArea_m2, surfaces);
  EXPECT_EQ(surfaces.planes.size(), 2u);
  EXPECT_EQ(surfaces.labels, before);
}

TEST(PlaneView, WhatLeansOverATopDoesNotOccupyIt) {
  // A wall that rises behind the top and leans over it by 20 deg: 100 mm at its upper end.
  const std::vector<Slab> slabs = {SlabAt(0.0, 1.0, 1.2, {0.4, 0.4}),
                                   SlabAt(0.0, 0.86, 1.35, {0.4, 0.298}, -110.0)};
  const SurfaceGrid grid(RaysOnto(slabs, 0.3, 0.001, 5), 62000);
  const SurfacePlanes surfaces =
      Labelled(grid, 2, [](const Eigen::Vector3d& at) { return at.y() < 0.99 ? 1 : 0; });
  ASSERT_EQ(surfaces.planes.size(), 2u);
  const PlaneView view = ViewOfPlane(grid, surfaces, 0, 0.15);
  ASSERT_FALSE(view.occupied.empty());
  for (const auto& sample : view.occupied)
    EXPECT_LT(surfaces.planes[0].plane.Distance(grid[sample.point].point), 0.05);
}

}  // namespace
}  // namespace foresight
