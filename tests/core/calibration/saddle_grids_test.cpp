// Boards in images as a program draws them: no noise, corners between pixels.
#include "core/calibration/saddle_grids.h"

#include <gtest/gtest.h>

#include <ctime>

#include "core/calibration/checkerboard_finder.h"
#include "core/calibration/saddle_points.h"

namespace foresight {
namespace {

constexpr std::uint8_t kLight = 220, kDark = 30;

GrayImage Drawn(int columns, int rows, int square_px) {
  GrayImage image((columns + 3) * square_px, (rows + 3) * square_px, kLight);
  for (int y = square_px; y < image.height() - square_px; ++y)
    for (int x = square_px; x < image.width() - square_px; ++x)
      if ((x / square_px + y / square_px) % 2 == 0) image(x, y) = kDark;
  return image;
}

TEST(SaddleGrids, FindsABoardWhoseCornersLieBetweenPixels) {
  for (const int square_px : {8, 12, 20, 40}) {
    SCOPED_TRACE(testing::Message() << "squares of " << square_px << " px");
    const std::vector<CornerGrid> grids = FindGrids(Drawn(9, 6, square_px));
    ASSERT_EQ(grids.size(), 1u);
    EXPECT_EQ(std::max(grids[0].columns, grids[0].rows), 9);
    EXPECT_EQ(std::min(grids[0].columns, grids[0].rows), 6);
  }
}

TEST(SaddleGrids, ACornerBetweenPixelsIsOnePoint) {
  EXPECT_EQ(FindSaddlePoints(Drawn(9, 6, 20)).size(), 54u);
}

// Every point beside every other one took 1.1 s for this image, and four times that for twice the
// points. 20 ms are said; ten times that for a busy machine.
TEST(SaddlePoints, ManyCornersTakeNoLongerThanTheirNumber) {
  const GrayImage image = Drawn(157, 116, 8);
  const std::clock_t start = std::clock();
  EXPECT_EQ(FindSaddlePoints(image).size(), 1500u);
  EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 0.4);
}

}  // namespace
}  // namespace foresight
