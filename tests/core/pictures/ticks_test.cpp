#include "core/pictures/ticks.h"

#include <gtest/gtest.h>

namespace foresight {
namespace {

using Labels = std::vector<std::string>;

TEST(LinearTicks, AreRoundAndHaveJustTheDecimalsTheyNeed) {
  EXPECT_EQ(LinearTicks(0.0, 50.0, 5).labels, (Labels{"0", "10", "20", "30", "40", "50"}));
  EXPECT_EQ(LinearTicks(0.93, 2.1, 5).labels, (Labels{"1.0", "1.5", "2.0"}));
  EXPECT_EQ(LinearTicks(-0.2, 0.2, 4).labels, (Labels{"-0.2", "-0.1", "0.0", "0.1", "0.2"}));
}

TEST(LinearTicks, AreNoFinerThanAsked) {
  EXPECT_EQ(LinearTicks(1.0, 3.0, 10, 1.0).labels, (Labels{"1", "2", "3"}));
}

TEST(LogarithmicTicks, AreDecadesWithStepsBetweenWhereThereIsRoom) {
  EXPECT_EQ(LogarithmicTicks(0.1, 1000.0).labels, (Labels{"0.1", "1", "10", "100", "1000"}));
  EXPECT_EQ(LogarithmicTicks(1.0, 20.0).labels, (Labels{"1", "2", "5", "10", "20"}));
}

}  // namespace
}  // namespace foresight
