#include "ui/viewmodels/region_gesture.h"

#include <gtest/gtest.h>

#include <Qt>

namespace foresight {
namespace {

using Points = RegionGesture::Points;

TEST(RegionGesture, ARectangleIsDragged) {
  RegionGesture gesture;
  EXPECT_FALSE(gesture.Press({10, 20}));
  gesture.Move({30, 40});
  EXPECT_EQ(gesture.Preview().size(), 4U);
  const auto points = gesture.Release({50, 60});
  ASSERT_TRUE(points);
  EXPECT_EQ(*points, (Points{{10, 20}, {50, 60}}));
  EXPECT_FALSE(gesture.Active());
}

TEST(RegionGesture, APolygonIsClickedAndClosedWithEnter) {
  RegionGesture gesture;
  gesture.SetShape(RegionShape::kPolygon);
  for (const Eigen::Vector2d& corner : {Eigen::Vector2d(0, 0), {40, 0}}) {
    EXPECT_FALSE(gesture.Press(corner));
    EXPECT_FALSE(gesture.Release(corner));
  }
  ASSERT_TRUE(gesture.Key(Qt::Key_Return));
  EXPECT_TRUE(gesture.Active()) << "two corners are no polygon yet";
  gesture.Press({40, 40});
  const auto closed = gesture.Key(Qt::Key_Return);
  ASSERT_TRUE(closed && *closed);
  EXPECT_EQ((*closed)->size(), 3U);
}

TEST(RegionGesture, BackspaceTakesTheLastCornerBackAndADoubleClickCloses) {
  RegionGesture gesture;
  gesture.SetShape(RegionShape::kPolygon);
  for (const Eigen::Vector2d& corner : {Eigen::Vector2d(0, 0), {40, 0}, {99, 99}})
    gesture.Press(corner);
  gesture.Key(Qt::Key_Backspace);
  gesture.Press({0, 40});
  const auto closed = gesture.Close();
  ASSERT_TRUE(closed);
  EXPECT_EQ(*closed, (Points{{0, 0}, {40, 0}, {0, 40}}));
}

TEST(RegionGesture, TwoClicksNeedNoDragging) {
  RegionGesture gesture;
  gesture.SetShape(RegionShape::kTwoClicks);
  EXPECT_FALSE(gesture.Press({10, 10}));
  EXPECT_FALSE(gesture.Release({10, 10}));
  gesture.Move({20, 10});
  EXPECT_GT(gesture.Preview().size(), 8U) << "a circle";
  const auto points = gesture.Press({30, 10});
  ASSERT_TRUE(points);
  EXPECT_EQ(*points, (Points{{10, 10}, {30, 10}}));
}

TEST(RegionGesture, EscapeEndsItWithoutARegion) {
  for (const auto shape :
       {RegionShape::kRectangle, RegionShape::kPolygon, RegionShape::kTwoClicks}) {
    RegionGesture gesture;
    gesture.SetShape(shape);
    gesture.Press({10, 10});
    const auto handled = gesture.Key(Qt::Key_Escape);
    ASSERT_TRUE(handled);
    EXPECT_FALSE(*handled);
    EXPECT_FALSE(gesture.Active());
    EXPECT_FALSE(gesture.Release({50, 50}));
  }
}

TEST(RegionGesture, OtherKeysBelongToTheWindow) {
  RegionGesture gesture;
  EXPECT_FALSE(gesture.Key(Qt::Key_Escape));
  gesture.Press({10, 10});
  EXPECT_FALSE(gesture.Key(Qt::Key_Left));
  EXPECT_TRUE(gesture.Active());
}

}  // namespace
}  // namespace foresight
