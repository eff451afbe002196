#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/simulation/image_sensor.h"

namespace foresight {
namespace {

TEST(ToneCurve, IsThePowerInEveryBit) {
  for (const double gamma : {0.5, 1.0, 2.2}) {
    const ToneCurve tone(gamma);
    Random random(1);
    for (int i = 0; i < 100'000; ++i) {
      const double level = i < 5000 ? i / 5000.0 : random.Uniform();
      ASSERT_EQ(tone(level), std::lround(255.0 * std::pow(level, 1.0 / gamma)))
          << level << ", gamma " << gamma;
    }
    EXPECT_EQ(tone(0.0), 0);
    EXPECT_EQ(tone(1.0), 255);
  }
}

}  // namespace
}  // namespace foresight
