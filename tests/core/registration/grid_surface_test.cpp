#include "core/registration/grid_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/registration/export_cloud.h"
#include "tests/support/swept_plane.h"

namespace foresight {
namespace {

Eigen::Vector3d PlaceOf(const CloudPoint& point) {
  return {point.x, point.y, point.z};
}

double AreaOf(const std::vector<std::array<std::int32_t, 3>>& triangles,
              const std::vector<CloudPoint>& points) {
  double area = 0.0;
  for (const auto& triangle : triangles) {
    const Eigen::Vector3d a = PlaceOf(points[static_cast<std::size_t>(triangle[0])]);
    const Eigen::Vector3d b = PlaceOf(points[static_cast<std::size_t>(triangle[1])]);
    const Eigen::Vector3d c = PlaceOf(points[static_cast<std::size_t>(triangle[2])]);
    area += 0.5 * (b - a).cross(c - a).norm();
  }
  return area;
}

TEST(GridSurface, AWallIsClosedAndFacesTheLidarWhicheverWayTheHeadTurns) {
  for (const double sign : {1.0, -1.0}) {
    Scan scan = SweptPlane({Eigen::Vector3d::UnitZ(), 2.0}, -10, 10, 10);
    if (sign < 0.0) {  // the same lines, the last one first
      SharedList<LidarLine> reversed;
      for (std::size_t i = scan.lines.size(); i-- > 0;) reversed.push_back(scan.lines[i]);
      scan.lines = reversed;
    }
    const RegisteredScan cloud = RegisterScan(scan, {}).value();
    const std::vector<CloudPoint> points = PointsInRobot(cloud, scan);
    const auto triangles = GridSurface(cloud, {}).value();
    // Up to 60 deg from the axis the wall is closed: each cell of the grid gives two triangles.
    EXPECT_GT(triangles.size(), 2u * static_cast<std::size_t>(cloud.lines - 1) * 480);
    const Eigen::Vector3d eye = scan.rig.robot_from_base * cloud.origins[0].cast<double>();
    for (const auto& t : triangles) {
      const Eigen::Vector3d a = PlaceOf(points[static_cast<std::size_t>(t[0])]);
      const Eigen::Vector3d normal =
          (PlaceOf(points[static_cast<std::size_t>(t[1])]) - a)
              .cross(PlaceOf(points[static_cast<std::size_t>(t[2])]) - a);
      ASSERT_GE(normal.dot(eye - a), 0.0);
    }
  }
}

TEST(GridSurface, AnEdgeInDepthStaysOpen) {
  const Scan near = SweptPlane({Eigen::Vector3d::UnitZ(), 1.0}, -10, 10, 10);
  Scan scan = SweptPlane({Eigen::Vector3d::UnitZ(), 3.0}, -10, 10, 10);
  SharedList<LidarLine> lines;
  for (std::size_t i = 0; i < scan.lines.size(); ++i) {
    LidarLine line = scan.lines[i];
    // The middle of the line sees a board one metre away.
    for (std::size_t beam = 500; beam < 580; ++beam)
      line.range_mm[beam] = near.lines[i].range_mm[beam];
    lines.push_back(line);
  }
  scan.lines = lines;
  const RegisteredScan cloud = RegisterScan(scan, {}).value();
  const std::vector<CloudPoint> points = PointsInRobot(cloud, scan);
  const auto triangles = GridSurface(cloud, {}).value();
  for (const auto& t : triangles) {
    double nearest = 1e9, farthest = 0.0;
    for (const std::int32_t corner : t) {
      const bool on_board = points[static_cast<std::size_t>(corner)].beam >= 500 &&
                            points[static_cast<std::size_t>(corner)].beam < 580;
      nearest = std::min(nearest, on_board ? 1.0 : 3.0);
      farthest = std::max(farthest, on_board ? 1.0 : 3.0);
    }
    ASSERT_EQ(nearest, farthest) << "a triangle joins the board and the wall behind it";
  }
}

TEST(GridSurface, AHoleOfOneBeamTakesItsOwnTrianglesOnly) {
  Scan scan = SweptPlane({Eigen::Vector3d::UnitZ(), 2.0}, -10, 10, 10);
  const RegisteredScan whole = RegisterScan(scan, {}).value();
  SharedList<LidarLine> lines;
  for (std::size_t i = 0; i < scan.lines.size(); ++i) {
    LidarLine line = scan.lines[i];
    if (i == 20) line.range_mm[540] = 1;  // no echo
    lines.push_back(line);
  }
  scan.lines = lines;
  const RegisteredScan holed = RegisterScan(scan, {}).value();
  // Six or eight triangles meet in a point; each of its four cells keeps the one without it.
  EXPECT_EQ(GridSurface(whole, {}).value().size() - GridSurface(holed, {}).value().size(), 4u);
  EXPECT_LT(AreaOf(GridSurface(holed, {}).value(), PointsInRobot(holed, scan)),
            AreaOf(GridSurface(whole, {}).value(), PointsInRobot(whole, scan)));
}

TEST(GridSurface, OneLineMakesNoSurface) {
  Scan scan = SweptPlane({Eigen::Vector3d::UnitZ(), 2.0}, -10, 10, 10);
  SharedList<LidarLine> one;
  one.push_back(scan.lines[0]);
  scan.lines = one;
  const auto surface = GridSurface(RegisterScan(scan, {}).value(), {});
  ASSERT_FALSE(surface);
  EXPECT_EQ(surface.error().code, ErrorCode::kTooFewPoints);
}

TEST(GridSurface, OptionsThatMakeNoSenseAreRefusedByName) {
  const RegisteredScan cloud =
      RegisterScan(SweptPlane({Eigen::Vector3d::UnitZ(), 2.0}, -10, 10, 10), {}).value();
  const auto surface = GridSurface(cloud, {.max_side_ratio = 0.0});
  ASSERT_FALSE(surface);
  EXPECT_EQ(surface.error().code, ErrorCode::kInvalidOptions);
  EXPECT_NE(surface.error().message.find("max_side_ratio"), std::string::npos);
}

}  // namespace
}  // namespace foresight
