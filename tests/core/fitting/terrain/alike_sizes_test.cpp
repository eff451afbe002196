#include "core/fitting/terrain/alike_sizes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace foresight {
namespace {

TEST(AlikeSizes, AMapsMarginSaysMoreThanLidarReturns) {
  EXPECT_GT(NatsOfSize(0.05, true, false), NatsOfSize(0.05, false, false));
  EXPECT_LT(NatsOfSize(-0.15, true, false), NatsOfSize(-0.15, false, false));
  EXPECT_LT(NatsOfSize(-0.15, false, false), 0.0);
  EXPECT_GT(NatsOfSize(0.05, false, true), NatsOfSize(-0.04, false, true) + 3.0)
      << "with an image returns tell, too";
  EXPECT_GT(NatsOfSize(0.05, true, true), NatsOfSize(-0.04, true, true) + 3.0);
  EXPECT_EQ(NatsOfSize(0.5, true, false), NatsOfSize(0.05, true, false))
      << "there is no larger margin";
  EXPECT_EQ(NatsOfSize(-0.5, true, false), NatsOfSize(-0.19, true, false));
}

TEST(AlikeSizes, TheOthersTellOfATopThatIsNotMeasured) {
  const double unknown = std::nan("");
  const std::vector<double> blocks = {unknown, 3.0, 3.0, 3.0, 3.0};
  const std::vector<double> cartons = {unknown, -3.0, -3.0, -3.0, -3.0};
  EXPECT_GT(NatsAmongOthers(blocks)[0], 2.0);
  EXPECT_LT(NatsAmongOthers(cartons)[0], -2.0);
  EXPECT_NEAR(NatsAmongOthers(std::vector<double>{unknown})[0], 0.0, 1e-9) << "nothing is known";
}

TEST(AlikeSizes, WhereAllAreBlocksOneThatIsHardToSeeIsOne) {
  const std::vector<double> blocks = {-1.0, 3.0, 3.0, 3.0, 3.0, 3.0, 3.0};
  EXPECT_GT(NatsAmongOthers(blocks)[0], 1.5);
}

TEST(AlikeSizes, AmongOtherThingsOneTellsForItself) {
  // Half are blocks: what a top's own size says decides.
  const std::vector<double> mixed = {4.0, 4.0, 4.0, 4.0, -5.0, -5.0, -5.0, -5.0};
  const std::vector<double> nats = NatsAmongOthers(mixed);
  EXPECT_GT(nats[0], 1.0);
  EXPECT_LT(nats[7], -1.5);
}

TEST(AlikeSizes, ACartonAmongBlocksIsNone) {
  const std::vector<double> one_carton = {-6.0, 4.0, 4.0, 4.0, 4.0, 4.0};
  EXPECT_LT(NatsAmongOthers(one_carton)[0], 1.5);
  EXPECT_GT(NatsAmongOthers(one_carton)[1], 2.0);
}

}  // namespace
}  // namespace foresight
