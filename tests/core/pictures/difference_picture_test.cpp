#include "core/pictures/difference_picture.h"

#include <gtest/gtest.h>

#include <cmath>

namespace foresight {
namespace {

struct Maps {
  DepthImage first{8, 4, 2.0f};
  DepthImage second{8, 4, 2.0f};
  MaskImage first_mask{8, 4, 255};
  MaskImage second_mask{8, 4, 255};

  ColorImage Painted() const {
    return PaintDifference(CompareDepth(first, first_mask, second, second_mask), first, first_mask,
                           second, second_mask);
  }
};

TEST(DifferencePicture, IsWhiteWhereBothAgreeBlueWhereTheSecondIsNearerAndOrangeBeyond) {
  Maps maps;
  maps.second(1, 1) = 2.0f - 0.03f;
  maps.second(2, 1) = 2.0f + 0.03f;
  const ColorImage picture = maps.Painted();
  EXPECT_EQ(picture(0, 0), (Rgb8{255, 255, 255}));
  EXPECT_GT(picture(1, 1).b, picture(1, 1).r + 100);
  EXPECT_GT(picture(2, 1).r, picture(2, 1).b + 100);
}

TEST(DifferencePicture, PixelsOfOneMapAloneHaveColoursThatNoDifferenceHas) {
  Maps maps;
  maps.second_mask(0, 0) = 0;
  maps.first(1, 0) = std::nanf("");
  maps.first_mask(2, 0) = maps.second_mask(2, 0) = 0;
  const ColorImage picture = maps.Painted();
  EXPECT_EQ(picture(0, 0), kColorOnlyInA);
  EXPECT_EQ(picture(1, 0), kColorOnlyInB);
  EXPECT_LT(picture(2, 0).r + picture(2, 0).g + picture(2, 0).b, 100);
  for (int i = 0; i <= 100; ++i) {
    const Rgb8 color = ColorOf(ColorMap::kBalance, 0.01 * i);
    EXPECT_NE(color, kColorOnlyInA);
    EXPECT_NE(color, kColorOnlyInB);
  }
}

TEST(DifferencePicture, TheChartHasEveryBinInPercent) {
  Maps maps;
  maps.second(0, 0) = 2.0f + 0.0105f;
  const LineChart chart =
      ChartOfDifference(CompareDepth(maps.first, maps.first_mask, maps.second, maps.second_mask));
  ASSERT_EQ(chart.series.size(), 1u);
  double sum = 0.0;
  for (const Eigen::Vector2d& point : chart.series[0].points) sum += point.y();
  EXPECT_NEAR(sum, 100.0, 1e-9);
  EXPECT_NEAR(chart.series[0].points[40].x(), 10.5, 1e-9);
  EXPECT_NEAR(chart.series[0].points[40].y(), 100.0 / 32.0, 1e-9);
}

}  // namespace
}  // namespace foresight
