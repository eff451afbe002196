#include "core/depth/pipeline.h"

#include <gtest/gtest.h>

#include "tests/support/sample_grids.h"

namespace foresight {
namespace {

TEST(ComputeDepth, KeepsEverySampleWithItsReason) {
  AlignedSamples samples = SamplesOnLattice(200, 96, 4, 12, [](int u, int v) {
    return u == 100 && v == 48 ? 1.5 : u < 100 ? 1.0 : 2.0;
  });
  const std::size_t count = samples.samples.size();
  const auto result = ComputeDepth(samples, ColorImage(200, 96, {90, 90, 90}), {}, {});
  ASSERT_TRUE(result);
  EXPECT_EQ(result->samples.samples.size(), count);
  EXPECT_EQ(ReasonAt(result->samples, 4, 25), RejectReason::kFlying);
  EXPECT_EQ(result->mask.width(), 200);
}

TEST(ComputeDepth, RefusesSamplesThatBreakTheirPromises) {
  AlignedSamples samples = SamplesOnLattice(200, 96, 4, 12, [](int, int) { return 1.0; });
  samples.samples[3].depth_m = NAN;
  const auto result = ComputeDepth(samples, ColorImage(200, 96), {}, {});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kInvalidInput);
  EXPECT_NE(result.error().message.find("sample 3"), std::string::npos);
}

TEST(ComputeDepth, CanBeCancelled) {
  std::stop_source stop;
  stop.request_stop();
  RunContext context;
  context.stop = stop.get_token();
  const AlignedSamples samples = SamplesOnLattice(200, 96, 4, 12, [](int, int) { return 1.0; });
  EXPECT_EQ(ComputeDepth(samples, ColorImage(200, 96), {}, context).error().code,
            ErrorCode::kCancelled);
}

}  // namespace
}  // namespace foresight
