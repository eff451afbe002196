#include "core/pictures/error_picture.h"

#include <gtest/gtest.h>

#include <cmath>

namespace foresight {
namespace {

TEST(PaintError, ColoursTheDistanceFromTheTruthEitherWay) {
  DepthImage depth(3, 1, 2.0f), truth(3, 1, 2.0f);
  depth(1, 0) = 2.025f;
  depth(2, 0) = 1.0f;
  const ColorImage picture = PaintError(depth, nullptr, truth, 0.050);
  EXPECT_EQ(picture(0, 0), ColorOf(ColorMap::kTurbo, 0.0));
  EXPECT_EQ(picture(1, 0), ColorOf(ColorMap::kTurbo, 0.5));
  EXPECT_EQ(picture(2, 0), ColorOf(ColorMap::kTurbo, 1.0));
}

TEST(PaintError, TellsMaskedAndUnknownPixelsApartAsItsLegendSays) {
  const DepthImage depth(3, 1, 2.0f);
  DepthImage truth(3, 1, 2.0f);
  MaskImage mask(3, 1, 255);
  mask(1, 0) = 0;
  truth(2, 0) = NAN;
  const ColorImage picture = PaintError(depth, &mask, truth, 0.050);
  const auto swatches = LegendOfError(0.050).swatches;
  EXPECT_EQ(picture(1, 0), swatches[0].color);
  EXPECT_EQ(picture(2, 0), swatches[1].color);
  EXPECT_NE(picture(1, 0), picture(2, 0));
}

TEST(PaintError, APixelWithoutDepthIsMasked) {
  const ColorImage picture =
      PaintError(DepthImage(1, 1, NAN), nullptr, DepthImage(1, 1, 2.0f), 0.050);
  EXPECT_EQ(picture(0, 0), LegendOfError(0.050).swatches[0].color);
}

TEST(WithLegend, LeavesTheImageAsItIs) {
  const ColorImage picture(320, 100, {10, 20, 30});
  const ColorImage page = WithLegend(picture, LegendOfError(0.050));
  EXPECT_EQ(page.width(), 320);
  ASSERT_GT(page.height(), 140);
  for (int y = 0; y < 100; ++y) ASSERT_EQ(page(319, y), (Rgb8{10, 20, 30}));
}

TEST(WithLegend, TheBarHasTheMapsColoursFromEndToEnd) {
  PictureLegend legend;
  legend.bar = {ColorMap::kViridis, {0.0, 50.0}, "mm", false};
  const ColorImage page = WithLegend(ColorImage(320, 10), legend);
  int purple = 0, yellow = 0;
  for (const Rgb8& pixel : page.values()) {
    purple += pixel == ColorOf(ColorMap::kViridis, 0.0) ? 1 : 0;
    yellow += pixel == ColorOf(ColorMap::kViridis, 1.0) ? 1 : 0;
  }
  EXPECT_GT(purple, 0);
  EXPECT_GT(yellow, 0);
}

TEST(WithLegend, ALineThatIsTooLongStaysInsideTheImage) {
  PictureLegend legend;
  legend.lines = {std::string(500, 'w')};
  const ColorImage page = WithLegend(ColorImage(320, 10), legend);
  for (int y = 10; y < page.height(); ++y) ASSERT_EQ(page(319, y), (Rgb8{255, 255, 255})) << y;
}

}  // namespace
}  // namespace foresight
