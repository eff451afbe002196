#include "core/evaluation/paired_lead.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace foresight {
namespace {

TEST(PairedLead, CountsTheScenesThatOneHasRightAndTheOtherHasNot) {
  const std::array first = {1, 1, 1, 0, 1};
  const std::array second = {1, 0, 0, 1, 1};
  const PairedLead lead = PairedLeadOf(first, second);
  EXPECT_EQ(lead.scenes, 5);
  EXPECT_EQ(lead.only_first, 2);
  EXPECT_EQ(lead.only_second, 1);
  EXPECT_DOUBLE_EQ(lead.lead, 0.2);
  EXPECT_LT(lead.low, 0.0);
  EXPECT_GT(lead.high, 0.2);
}

TEST(PairedLead, CountsEachThingOfASceneThatHoldsSeveral) {
  const PairedLead lead = PairedLeadOf(std::array{7, 4}, std::array{5, 5});
  EXPECT_EQ(lead.only_first, 2);
  EXPECT_EQ(lead.only_second, 1);
  EXPECT_DOUBLE_EQ(lead.lead, 0.5);
}

// Agresti and Min 2005: a half is added to each of the four counts.
TEST(PairedLead, HasTheIntervalOfTheBook) {
  std::vector<int> first(100, 1), second(100, 1);
  for (std::size_t i = 0; i < 20; ++i) (i < 15 ? second : first)[i] = 0;
  const PairedLead lead = PairedLeadOf(first, second);
  const double sigma = std::sqrt(16.0 + 6.0 - 10.0 * 10.0 / 102.0) / 102.0;
  EXPECT_NEAR(lead.low, 10.0 / 102.0 - 1.96 * sigma, 1e-12);
  EXPECT_NEAR(lead.high, 10.0 / 102.0 + 1.96 * sigma, 1e-12);
}

TEST(PairedLead, TenScenesWithoutADifferenceAreNoCertainty) {
  const std::vector<int> same(10, 1);
  const PairedLead lead = PairedLeadOf(same, same);
  EXPECT_EQ(lead.lead, 0.0);
  EXPECT_LT(lead.low, -0.1);
  EXPECT_GT(lead.high, 0.1);
  EXPECT_TRUE(std::isnan(PairedLeadOf({}, {}).lead));
}

}  // namespace
}  // namespace foresight
