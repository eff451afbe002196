#include "core/base/quantile.h"

#include <gtest/gtest.h>

#include <cmath>

namespace foresight {
namespace {

TEST(Quantile, LiesBetweenTwoValuesInProportion) {
  EXPECT_EQ(Quantile({3.0, 1.0, 2.0}, 0.5), 2.0);
  EXPECT_EQ(Quantile({4.0, 1.0, 2.0, 3.0}, 0.5), 2.5);
  EXPECT_NEAR(Quantile({0.0, 10.0, 20.0, 30.0}, 0.95), 28.5, 1e-12);
  EXPECT_EQ(Quantile({7.0, 5.0}, 0.0), 5.0);
  EXPECT_EQ(Quantile({7.0, 5.0}, 1.0), 7.0);
  EXPECT_TRUE(std::isnan(Quantile({}, 0.5)));
  EXPECT_EQ(Quantile(std::vector<float>{4.0f, 1.0f, 2.0f, 3.0f}, 0.5), 2.5f);
}

TEST(ValueAtRank, IsTheValueThatStandsThereInOrder) {
  for (std::size_t rank = 0; rank < 4; ++rank)
    EXPECT_EQ(ValueAtRank<int>({30, 0, 20, 10}, rank), 10 * static_cast<int>(rank));
  EXPECT_THROW(ValueAtRank<int>({1}, 1), ContractViolation);
}

TEST(UpperMedian, IsOneOfTheValuesTheUpperOfTwoMiddleOnes) {
  EXPECT_EQ(UpperMedian<double>({3.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(UpperMedian<float>({4.0f, 1.0f, 2.0f, 3.0f}), 3.0f);
  EXPECT_TRUE(std::isnan(UpperMedian<double>({})));
}

}  // namespace
}  // namespace foresight
