#include "hardware/link/wire/line_limit.h"

#include <gmock/gmock.h>

namespace foresight {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

TEST(LineLimit, ARepeatedLineIsSaidOnceAMinuteWithItsCount) {
  LineLimit limit;
  LineLimit::Time now{seconds(1000)};
  EXPECT_EQ(limit.Pass("refused", now), "refused");
  for (int i = 1; i < 240; ++i)  // a station that tries again every 250 ms
    EXPECT_EQ(limit.Pass("refused", now + i * milliseconds(250)), std::nullopt);
  EXPECT_EQ(limit.Pass("refused", now + seconds(60)), "refused (239 times more before)");
  EXPECT_EQ(limit.Pass("refused", now + seconds(120)), "refused");
}

TEST(LineLimit, OtherLinesPassMeanwhile) {
  LineLimit limit;
  const LineLimit::Time now{seconds(1000)};
  EXPECT_TRUE(limit.Pass("a", now));
  EXPECT_TRUE(limit.Pass("b", now));
  EXPECT_FALSE(limit.Pass("a", now));
}

TEST(LineLimit, OfManyDifferentLinesTwentyASecondPass) {
  LineLimit limit;
  int passed = 0;
  for (int i = 0; i < 1000; ++i)  // two seconds
    if (limit.Pass(std::to_string(i), LineLimit::Time{seconds(1000) + i * milliseconds(2)}))
      ++passed;
  EXPECT_EQ(passed, 40);
}

}  // namespace
}  // namespace foresight
