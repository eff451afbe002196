#include "core/fitting/terrain/block_outline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/base/random.h"
#include "core/fitting/terrain/block_size.h"
#include "core/sensor/sensor_rig.h"

namespace foresight {
namespace {

constexpr double kTop_m = 0.39;

/// A top on a slope before a camera at base's origin, and beams that tell little of its edges.
class BlockInImage : public ::testing::Test {
 protected:
  BlockInImage() {
    camera_.camera = DefaultSensorRig().camera;
    const Eigen::AngleAxisd slope(0.7, Eigen::Vector3d::UnitX());
    view_.surface.center = {0.05, 0.1, 1.5};
    view_.x = Eigen::Vector3d::UnitX();
    view_.y = slope * Eigen::Vector3d::UnitY();
    view_.surface.plane.normal = view_.x.cross(view_.y);
    view_.surface.plane.offset = view_.surface.plane.normal.dot(view_.surface.center);
    for (const double x : {-0.3, 0.3})
      for (const double y : {-0.3, 0.3}) seen_.push_back(view_.InBase({x, y}));
  }

  /// The top, round the plane's centre, and what lies round it; with noise.
  ImageEdges EdgesOf(const Eigen::Vector2d& size_m, double top, double round) const {
    Random random(5);
    ColorImage image(camera_.camera.width, camera_.camera.height);
    const Plane& plane = view_.surface.plane;
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) {
        double value = round;
        if (const auto ray = camera_.camera.Unproject(Eigen::Vector2d(x, y))) {
          const double range_m = plane.offset / plane.normal.dot(*ray);
          const Eigen::Vector2d at = view_.Flat(range_m * *ray);
          if (range_m > 0.0 && (at.cwiseAbs().array() < 0.5 * size_m.array()).all()) value = top;
        }
        const auto noisy =
            static_cast<std::uint8_t>(std::clamp(value + 2.0 * random.Normal(), 0.0, 255.0));
        image(x, y) = {noisy, noisy, noisy};
      }
    return {image, camera_, seen_};
  }

  static BlockRectangle At(double x, double y, double yaw_rad = 0.0) {
    BlockRectangle rectangle;
    rectangle.center = {x, y};
    rectangle.yaw_rad = yaw_rad;
    rectangle.size_m = {kTop_m, kTop_m};
    return rectangle;
  }

  static PlacedRectangle Guess(const BlockRectangle& rectangle) {
    return {rectangle, 4e-4 * Eigen::Matrix2d::Identity(), 0.05};
  }

  ImageView camera_;
  PlaneView view_;
  std::vector<Eigen::Vector3d> seen_;
};

TEST_F(BlockInImage, IsPlacedOnTheEdgesOfItsTop) {
  const ImageEdges edges = EdgesOf({kTop_m, kTop_m}, 150.0, 90.0);
  const BlockOutline outline(edges, view_);
  for (const BlockRectangle& start : {At(0.025, -0.02, 0.04), At(-0.03, 0.01, -0.03)}) {
    const PlacedRectangle placed = outline.Place(Guess(start));
    EXPECT_LT(placed.rectangle.center.norm(), 0.005);
    EXPECT_NEAR(placed.rectangle.yaw_rad, 0.0, 0.012);
    EXPECT_LT(placed.covariance.trace(), 2e-4) << "its sides are seen";
    EXPECT_LT(placed.yaw_sigma_rad, 0.03);
  }
  EXPECT_GT(outline.Outline(At(0.0, 0.0)).nats, 1.5);
  EXPECT_NEAR(outline.Outline(At(0.0, 0.0)).shown, 1.0, 1e-9);
  EXPECT_LT(outline.Outline(At(0.08, 0.08)).nats, 0.5);
}

TEST_F(BlockInImage, StaysWhereItIsWhereTheImageShowsNothing) {
  const ImageEdges edges = EdgesOf({kTop_m, kTop_m}, 0.0, 0.0);
  const BlockOutline outline(edges, view_);
  const PlacedRectangle start = Guess(At(0.02, 0.01, 0.02));
  const PlacedRectangle placed = outline.Place(start);
  EXPECT_LT((placed.rectangle.center - start.rectangle.center).norm(), 0.004);
  EXPECT_TRUE(placed.covariance.isApprox(start.covariance));
  EXPECT_DOUBLE_EQ(placed.yaw_sigma_rad, start.yaw_sigma_rad);
  EXPECT_NEAR(outline.Outline(start.rectangle).nats, 0.0, 0.4);
}

TEST_F(BlockInImage, DoesNotLeaveTheImageForItsFaintSides) {
  // Only what lies left of the top's middle is kept of the image.
  std::erase_if(seen_, [](const Eigen::Vector3d& point) { return point.x() > 0.0; });
  const ImageEdges edges = EdgesOf({kTop_m, kTop_m}, 92.0, 90.0);
  const BlockOutline outline(edges, view_);
  const BlockRectangle start = At(-0.1, 0.0);
  EXPECT_LT(outline.Outline(start).shown, 0.9);
  const PlacedRectangle placed = outline.Place({start, 9e-4 * Eigen::Matrix2d::Identity(), 0.02});
  EXPECT_LT((placed.rectangle.center - start.center).norm(), 0.015);
  const RectangleInImage beyond = outline.Outline(At(1.0, 0.0));
  EXPECT_EQ(beyond.shown, 0.0);
  EXPECT_EQ(beyond.nats, 0.0);
}

TEST_F(BlockInImage, TellsLessOfWhereATurnedOneIs) {
  const ImageEdges edges = EdgesOf({kTop_m, kTop_m}, 150.0, 90.0);
  const BlockOutline outline(edges, view_);
  const PlacedRectangle straight = outline.Place(Guess(At(0.0, 0.0)));
  // Along the line of sight a step is fewer pixels than across it.
  EXPECT_GT(straight.covariance(1, 1), 1.3 * straight.covariance(0, 0));
  EXPECT_NEAR(straight.covariance(0, 1), 0.0, 1e-8);
}

TEST_F(BlockInImage, HasTheSizeThatTheImageShows) {
  // Beams that end on everything round the top, too, tell nothing of its size.
  view_.support.push_back({{0.0, 0.0}, 1e-4, 0});
  const ImageEdges of_block = EdgesOf({kTop_m, kTop_m}, 150.0, 90.0);
  const BlockOutline block(of_block, view_);
  EXPECT_NEAR(SizeMargin(view_, At(0.0, 0.0), {}, nullptr), 0.0, 0.01);
  EXPECT_GT(SizeMargin(view_, At(0.0, 0.0), {}, &block), 0.08);
  for (const double side_m : {0.33, 0.45}) {
    const ImageEdges of_carton = EdgesOf({kTop_m, side_m}, 150.0, 90.0);
    const BlockOutline carton(of_carton, view_);
    EXPECT_LT(SizeMargin(view_, At(0.0, 0.0), {}, &carton), -0.08) << side_m;
  }
}

}  // namespace
}  // namespace foresight
