#include "core/pictures/color_map.h"

#include <gtest/gtest.h>

namespace foresight {
namespace {

struct UniformMaps : testing::TestWithParam<ColorMap> {};

TEST_P(UniformMaps, GetBrighterAllTheWay) {
  double last = -1.0;
  for (double x = 0.0; x <= 1.0; x += 0.05) {
    const Rgb8 color = ColorOf(GetParam(), x);
    const double luma = 0.299 * color.r + 0.587 * color.g + 0.114 * color.b;
    EXPECT_GT(luma, last) << x;
    last = luma;
  }
}

INSTANTIATE_TEST_SUITE_P(ViridisAndCividis, UniformMaps,
                         testing::Values(ColorMap::kViridis, ColorMap::kCividis));

TEST(ColorMaps, ViridisRunsFromItsPurpleToItsYellow) {
  EXPECT_EQ(ColorOf(ColorMap::kViridis, 0.0), (Rgb8{68, 1, 84}));
  EXPECT_EQ(ColorOf(ColorMap::kViridis, 1.0), (Rgb8{253, 231, 37}));
}

TEST(ColorMaps, OffersTurboFirstForDepth) {
  ASSERT_EQ(DepthColorMaps().size(), 3u);
  EXPECT_EQ(DepthColorMaps()[0].map, ColorMap::kTurbo);
}

}  // namespace
}  // namespace foresight
