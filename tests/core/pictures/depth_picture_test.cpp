#include "core/pictures/depth_picture.h"

#include <gtest/gtest.h>

#include <cmath>

namespace foresight {
namespace {

TEST(PaintDepth, UsesTheMapItIsGiven) {
  const DepthImage depth(4, 4, 2.0f);
  const ColorImage picture = PaintDepth(depth, nullptr, ColorMap::kViridis, {2.0, 3.0});
  EXPECT_EQ(picture(1, 1), ColorOf(ColorMap::kViridis, 0.0));
}

TEST(PaintDepth, AMaskedPixelLooksTheSameInEveryMap) {
  const DepthImage depth(4, 4, 2.0f);
  const MaskImage mask(4, 4, 0);
  EXPECT_EQ(PaintDepth(depth, &mask, ColorMap::kViridis, {1.0, 3.0}),
            PaintDepth(depth, &mask, ColorMap::kTurbo, {1.0, 3.0}));
}

TEST(PaintConfidence, TheLargestConfidenceHasTheBrightestColour) {
  DenseDepth dense;
  dense.depth_m = DepthImage(2, 1, 2.0f);
  dense.confidence = FloatImage(2, 1, 7.0f);
  dense.max_confidence = 7.0f;
  EXPECT_EQ(PaintConfidence(dense, nullptr, {0.0, 1.0})(0, 0), ColorOf(ColorMap::kCividis, 1.0));
}

}  // namespace
}  // namespace foresight
