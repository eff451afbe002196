#include "core/fitting/ray_selection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace foresight {
namespace {

TEST(RaySelection, WhatLiesRoundAMapIsToldByTheBeamsBehindIt) {
  RaySet region;
  EXPECT_EQ(SurroundingBeams(region), nullptr);
  RaySet map;
  region.around = std::make_shared<const RaySet>(map);
  EXPECT_EQ(SurroundingBeams(region), region.around.get());
  map.beams = std::make_shared<const RaySet>();
  region.around = std::make_shared<const RaySet>(map);
  EXPECT_EQ(SurroundingBeams(region), map.beams.get());
}

/// Rays from the origin about z, in a square of 21 x 21; `range_m` of each by its column and row.
template <class RangeOf>
RaySet Square(const RangeOf& range_of) {
  RaySet rays;
  for (int row = -10; row <= 10; ++row)
    for (int column = -10; column <= 10; ++column)
      rays.rays.push_back({Eigen::Vector3d::Zero(),
                           Eigen::Vector3d(0.01 * column, 0.01 * row, 1.0).normalized(),
                           range_of(column, row),
                           {column, row}});
  return rays;
}

TEST(RaySelection, TheMiddleIsThatOfTheThingBetweenWhatIsBeforeAndBehindIt) {
  const RaySet rays = Square([](int column, int row) {
    if (row < -7) return 0.5;                                     // a table's edge before it
    if (std::abs(column) <= 3 && std::abs(row) <= 5) return 1.0;  // the thing
    return 3.0;                                                   // a wall behind it
  });
  const Eigen::Vector3d place = PlaceInMiddle(rays);
  EXPECT_NEAR(place.z(), 1.0, 0.01);
  EXPECT_LT(place.head<2>().norm(), 0.03);
  EXPECT_NEAR(MedianPlace(rays.rays).z(), 3.0, 0.03) << "most of what is seen is wall";
}

TEST(RaySelection, OneRayIsItsOwnMiddle) {
  RaySet one;
  one.rays.push_back({Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX(), 2.0, {0, 0}});
  EXPECT_EQ(PlaceInMiddle(one), Eigen::Vector3d(2.0, 0.0, 0.0));
  EXPECT_EQ(MedianPlace(one.rays), Eigen::Vector3d(2.0, 0.0, 0.0));
}

}  // namespace
}  // namespace foresight
