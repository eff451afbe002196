#include "core/depth/row_set.h"

#include <gtest/gtest.h>

namespace foresight {
namespace {

std::vector<int> RowsOf(const RowSet& set) {
  std::vector<int> rows;
  for (int y = 0; y < set.height(); ++y)
    if (set.Contains(y)) rows.push_back(y);
  return rows;
}

RowSet With(int height, std::initializer_list<int> rows) {
  RowSet set(height);
  for (const int row : rows) set.Add(row);
  return set;
}

TEST(RowSet, GrowsUpAndDownAndStopsAtTheEdges) {
  EXPECT_EQ(RowsOf(With(10, {0, 5, 9}).GrownBy(1)), (std::vector<int>{0, 1, 4, 5, 6, 8, 9}));
  EXPECT_EQ(RowsOf(With(4, {1}).GrownBy(7)), (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(RowsOf(With(4, {2}).GrownBy(0)), (std::vector<int>{2}));
}

TEST(RowSet, GrownRowsMayOverlap) {
  EXPECT_EQ(RowsOf(With(12, {3, 4, 6}).GrownBy(2)), (std::vector<int>{1, 2, 3, 4, 5, 6, 7, 8}));
}

TEST(RowSet, NamesEachBlockOnceAndTheLastOneThoughItIsCut) {
  EXPECT_EQ(With(20, {0, 7, 8, 19}).Blocks(8), (std::vector<int>{0, 1, 2}));
  EXPECT_TRUE(RowSet(20).Blocks(8).empty());
  EXPECT_EQ(RowSet(20, true).Blocks(8), (std::vector<int>{0, 1, 2}));
}

}  // namespace
}  // namespace foresight
