#include "core/fitting/roi.h"

#include <gtest/gtest.h>

#include <limits>

namespace foresight {
namespace {

TEST(ImageRoi, ARectangleHoldsWhatLiesBetweenItsCornersInAnyOrder) {
  const ImageRoi roi = ImageRoi::Rectangle(0.1, {30.0, 40.0}, {10.0, 20.0});
  EXPECT_TRUE(roi.Check());
  EXPECT_TRUE(roi.Contains({20.0, 30.0}));
  EXPECT_FALSE(roi.Contains({9.0, 30.0}));
  EXPECT_FALSE(roi.Contains({20.0, 41.0}));
}

TEST(ImageRoi, ItsBoundaryCountsAsInside) {
  const ImageRoi roi = ImageRoi::Rectangle(0.0, {10.0, 20.0}, {30.0, 40.0});
  for (const Eigen::Vector2d& pixel :
       {Eigen::Vector2d(10, 20), {30, 40}, {10, 33}, {30, 33}, {17, 20}, {17, 40}})
    EXPECT_TRUE(roi.Contains(pixel)) << pixel.transpose();
}

TEST(ImageRoi, ADentIsOutside) {
  const ImageRoi roi{0.0, {{0, 0}, {20, 0}, {20, 20}, {10, 5}, {0, 20}}};
  EXPECT_TRUE(roi.Contains({3.0, 10.0}));
  EXPECT_FALSE(roi.Contains({10.0, 15.0}));
}

TEST(ImageRoi, RefusesALineTwoCornersAndNaN) {
  EXPECT_FALSE(ImageRoi::Rectangle(0.0, {0.0, 0.0}, {100.0, 2.0}).Check());
  EXPECT_FALSE((ImageRoi{0.0, {{0, 0}, {10, 10}}}).Check());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE((ImageRoi{0.0, {{0, 0}, {10, 0}, {nan, 10}}}).Check());
  EXPECT_FALSE((ImageRoi{nan, {{0, 0}, {10, 0}, {0, 10}}}).Check());
}

TEST(ImageRoi, AnEmptyOneHoldsNothing) {
  EXPECT_FALSE(ImageRoi().Contains({0.0, 0.0}));
}

TEST(BoxRoi, AWayCrossesItThatEndsInItOrGoesThroughItAndNoOther) {
  const Eigen::AngleAxisd quarter(1.5707963267948966, Eigen::Vector3d::UnitZ());
  // Two metres long in y, as it is turned.
  const BoxRoi box{{Eigen::Quaterniond(quarter), {3.0, 0.0, 0.0}}, {2.0, 0.5, 0.5}};
  const Eigen::Vector3d from = Eigen::Vector3d::Zero();
  EXPECT_TRUE(box.Crosses(from, {3.0, 0.9, 0.0}));
  EXPECT_TRUE(box.Crosses(from, {6.0, 0.0, 0.0}));
  EXPECT_TRUE(box.Crosses(from, {6.0, 1.9, 0.0}));
  EXPECT_FALSE(box.Crosses(from, {2.7, 0.0, 0.0}));
  EXPECT_FALSE(box.Crosses(from, {6.0, 2.5, 0.0}));
  EXPECT_FALSE(box.Crosses(from, {-6.0, 0.0, 0.0}));
  EXPECT_FALSE(box.Crosses({0.0, 0.0, 1.0}, {6.0, 0.0, 1.0}));
}

}  // namespace
}  // namespace foresight
