#include "core/pictures/depth_view.h"

#include <gtest/gtest.h>

#include <cmath>

namespace foresight {
namespace {

constexpr int kWidth = 80;
constexpr int kHeight = 60;

RayOfPixel Pinhole() {
  return [](const Eigen::Vector2d& pixel) -> Eigen::Vector2d {
    return (pixel - Eigen::Vector2d(40.0, 30.0)) / 80.0;
  };
}

TEST(PointsOfDepth, PutsAPixelOnItsRayAtItsDepth) {
  DepthImage depth(kWidth, kHeight, NAN);
  depth(60, 10) = 2.0f;
  const ColorImage guide(kWidth, kHeight, {1, 2, 3});
  const auto points = PointsOfDepth(depth, nullptr, guide, Pinhole());
  ASSERT_EQ(points.size(), 1u);
  EXPECT_TRUE(points[0].position.isApprox(Eigen::Vector3f(0.5f, -0.5f, 2.0f)));
  EXPECT_EQ(points[0].color, (Rgb8{1, 2, 3}));
}

TEST(PointsOfDepth, LeavesMaskedPixelsAndThoseWithoutARayOut) {
  const DepthImage depth(kWidth, kHeight, 2.0f);
  MaskImage mask(kWidth, kHeight, 0);
  mask(3, 3) = mask(4, 4) = 255;
  const auto points =
      PointsOfDepth(depth, &mask, ColorImage(kWidth, kHeight), [](const Eigen::Vector2d& pixel) {
        return Eigen::Vector2d(pixel.x() < 4.0 ? std::nan("") : 0.0, 0.0);
      });
  EXPECT_EQ(points.size(), 1u);
}

struct ObliqueView : testing::TestWithParam<double> {};

TEST_P(ObliqueView, ShowsNearlyAllPointsAndFillsTheImage) {
  DepthImage depth(kWidth, kHeight, static_cast<float>(GetParam()));
  for (int y = 20; y < 40; ++y)
    for (int x = 30; x < 50; ++x) depth(x, y) *= 0.6f;
  const auto points = PointsOfDepth(depth, nullptr, ColorImage(kWidth, kHeight), Pinhole());
  const CloudView view = ObliqueViewOf(points, 400, 300);
  int inside = 0;
  double left = 400.0, right = 0.0;
  for (const ColoredPoint& point : points) {
    const Eigen::Vector2d pixel = ProjectToCloudPicture(point.position.cast<double>(), view);
    inside += pixel.x() >= 0.0 && pixel.x() < 400.0 && pixel.y() >= 0.0 && pixel.y() < 300.0;
    left = std::min(left, pixel.x());
    right = std::max(right, pixel.x());
  }
  // Up to 2 % may be cut off on each of the four sides.
  EXPECT_GE(inside, static_cast<int>(0.92 * static_cast<double>(points.size())));
  EXPECT_GT(right - left, 200.0);
}
INSTANTIATE_TEST_SUITE_P(NearAndFar, ObliqueView, testing::Values(0.5, 3.0, 40.0));

TEST(ObliqueView, OfAVeryWideWallHasItAllInFront) {
  const auto points = PointsOfDepth(
      DepthImage(kWidth, kHeight, 1.0f), nullptr, ColorImage(kWidth, kHeight),
      [](const Eigen::Vector2d& pixel) { return Eigen::Vector2d((pixel.x() - 40.0) / 4.0, 0.0); });
  const CloudView view = ObliqueViewOf(points, 400, 300);
  for (const ColoredPoint& point : points)
    ASSERT_TRUE(ProjectToCloudPicture(point.position.cast<double>(), view).allFinite());
}

}  // namespace
}  // namespace foresight
