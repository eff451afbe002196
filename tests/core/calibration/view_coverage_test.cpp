#include "core/calibration/view_coverage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

#include "core/geometry/angles.h"
#include "tests/core/calibration/synthetic_views.h"

namespace foresight {
namespace {

using testing::HasSubstr;
using testing::Not;

ImageErrors At(const CameraFromPattern& pose) {
  ImageErrors errors;
  errors.camera_from_pattern = pose;
  return errors;
}

std::vector<ImageErrors> PosesOf(const SyntheticViews& views) {
  std::vector<ImageErrors> errors;
  for (const CameraFromPattern& pose : views.truth.poses) errors.push_back(At(pose));
  return errors;
}

ViewCoverage CoverageOfAll(const SyntheticViews& views) {
  return MeasureCoverage(views.truth.board, views.images, views.truth.camera.width,
                         views.truth.camera.height, PosesOf(views));
}

/// A board in the middle, 1 m away, whose named edge is turned away by `tilt_deg`.
ImageErrors Tilted(const CalibrationBoard& board, double tilt_deg, const Eigen::Vector3d& axis) {
  const Eigen::Vector3d middle = 0.5 * (board.Corner(0) + board.Corner(board.CornerCount() - 1));
  const Eigen::Quaterniond rotation(Eigen::AngleAxisd(RadiansFromDegrees(tilt_deg), axis));
  return At(CameraFromPattern(rotation, Eigen::Vector3d(0.0, 0.0, 1.0) - rotation * middle));
}

TEST(ViewCoverage, CountsEachCornerOnce) {
  const SyntheticViews views = MakeViews({.views = 7}, 1);
  const ViewCoverage coverage = CoverageOfAll(views);
  const int corners = 7 * views.truth.board.CornerCount();
  EXPECT_EQ(std::accumulate(coverage.cells.begin(), coverage.cells.end(), 0), corners);
  EXPECT_EQ(std::accumulate(coverage.rings.begin(), coverage.rings.end(), 0), corners);
  EXPECT_EQ(std::accumulate(coverage.tilts.begin(), coverage.tilts.end(), 0), 7);
  EXPECT_EQ(std::accumulate(coverage.distances.begin(), coverage.distances.end(), 0), 7);
}

TEST(ViewCoverage, TellsWhichEdgeOfABoardIsAway) {
  const CalibrationBoard board;
  // About the y axis, which points down, a positive turn moves the right edge away (x to -z).
  const auto away = [&](double tilt_deg, const Eigen::Vector3d& axis) {
    return MeasureCoverage(board, {{}}, 100, 100, {Tilted(board, tilt_deg, axis)}).away;
  };
  EXPECT_EQ(away(30.0, -Eigen::Vector3d::UnitY())[ViewCoverage::kRight], 1);
  EXPECT_EQ(away(30.0, Eigen::Vector3d::UnitY())[ViewCoverage::kLeft], 1);
  EXPECT_EQ(away(30.0, Eigen::Vector3d::UnitX())[ViewCoverage::kBottom], 1);
  EXPECT_EQ(away(30.0, -Eigen::Vector3d::UnitX())[ViewCoverage::kTop], 1);
  EXPECT_EQ(away(15.0, Eigen::Vector3d::UnitX()), (std::array<int, 4>{}));
}

TEST(NextImage, AsksForTheEdgeThatHasNoCorners) {
  SyntheticViews views = MakeViews({.views = 40}, 2);
  const double limit = 0.3 * views.truth.camera.width;
  for (std::size_t i = views.images.size(); i-- > 0;) {
    const auto& pixels = views.images[i].view.pixels;
    if (std::none_of(pixels.begin(), pixels.end(), [&](const auto& p) { return p.x() < limit; }))
      continue;
    views.images.erase(views.images.begin() + static_cast<std::ptrdiff_t>(i));
    views.truth.poses.erase(views.truth.poses.begin() + static_cast<std::ptrdiff_t>(i));
  }
  ASSERT_GE(views.images.size(), 4u);
  EXPECT_THAT(NextImage(CoverageOfAll(views), 4), HasSubstr("at the left edge"));
}

TEST(NextImage, AsksForTiltWhereBoardsAreHeldStraight) {
  const SyntheticViews views = MakeViews({.views = 40, .largest_tilt_rad = 0.05}, 3);
  EXPECT_THAT(NextImage(CoverageOfAll(views), 4), HasSubstr("tilted by over 20 deg"));
}

TEST(NextImage, AsksForNothingAfterAGoodSet) {
  const SyntheticViews views = MakeViews({.views = 80}, 4);  // random ones rarely hit a corner
  EXPECT_EQ(NextImage(CoverageOfAll(views), 4), "");
}

TEST(NextImage, WithoutAnImageTheBoardComesToTheMiddle) {
  EXPECT_THAT(NextImage({}, 4), HasSubstr("in the middle"));
}

}  // namespace
}  // namespace foresight
