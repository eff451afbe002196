#include "core/fitting/terrain/block_size.h"

#include <gtest/gtest.h>

namespace foresight {
namespace {

constexpr double kCell_m = 0.01;

/// A top of this size round the origin, in the middle of beams that go on behind it.
PlaneView TopOf(const Eigen::Vector2d& size_m) {
  PlaneView view;
  const Eigen::Vector2d half = 0.5 * size_m;
  for (double y = -0.45; y < 0.45; y += kCell_m)
    for (double x = -0.45; x < 0.45; x += kCell_m) {
      const bool on_it = std::abs(x) <= half.x() && std::abs(y) <= half.y();
      (on_it ? view.support : view.through).push_back({{x, y}, kCell_m * kCell_m, 0});
    }
  return view;
}

BlockRectangle BlockAt(double x, double y) {
  BlockRectangle rectangle;
  rectangle.center = {x, y};
  rectangle.size_m = {0.39, 0.39};
  return rectangle;
}

TEST(BlockSize, OfABlockIsItsOwn) {
  EXPECT_GT(SizeMargin(TopOf({0.39, 0.39}), BlockAt(0.0, 0.0), {}, nullptr), 0.06);
  // A block that is not quite in its place, or not quite of its size, is one.
  EXPECT_GT(SizeMargin(TopOf({0.39, 0.39}), BlockAt(0.015, -0.01), {}, nullptr), 0.06);
  EXPECT_GT(SizeMargin(TopOf({0.40, 0.39}), BlockAt(0.0, 0.0), {}, nullptr), 0.03);
}

TEST(BlockSize, OfALongerOrAShorterThingIsAnother) {
  for (const double side_m : {0.30, 0.45, 0.50}) {
    EXPECT_LT(SizeMargin(TopOf({0.39, side_m}), BlockAt(0.0, 0.02), {}, nullptr), -0.05) << side_m;
    EXPECT_LT(SizeMargin(TopOf({side_m, 0.39}), BlockAt(0.02, 0.0), {}, nullptr), -0.05) << side_m;
  }
}

TEST(BlockSize, IsNotKnownWhereAnEdgeIsNotSeen) {
  PlaneView view = TopOf({0.39, 0.39});
  std::erase_if(view.through, [](const auto& sample) { return sample.at.x() > 0.0; });
  EXPECT_NEAR(SizeMargin(view, BlockAt(0.0, 0.0), {}, nullptr), 0.0, 0.01);
}

TEST(BlockSize, DoesNotCountTheNextBlock) {
  PlaneView view = TopOf({0.39, 0.39});
  for (auto it = view.through.begin(); it != view.through.end();) {
    const bool next = it->at.x() > 0.205 && std::abs(it->at.y()) < 0.195;
    if (next) view.support.push_back(*it);
    it = next ? view.through.erase(it) : it + 1;
  }
  const std::vector<BlockRectangle> others = {BlockAt(0.40, 0.0)};
  EXPECT_GT(SizeMargin(view, BlockAt(0.0, 0.0), others, nullptr), 0.02);
  EXPECT_LT(SizeMargin(view, BlockAt(0.0, 0.0), {}, nullptr), 0.0);
}

}  // namespace
}  // namespace foresight
