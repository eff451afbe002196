// How much memory a depth map needs while it is made, beyond the image and samples that go in and
// the result that comes out.
#include <gtest/gtest.h>

#include <thread>

#include "core/depth/depth_method.h"
#include "tests/benchmark/room.h"
#include "tests/core/depth/counted_heap.h"

namespace foresight {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;

TEST(CountedHeap, SeesWhatIsHeldAndWhatWas) {
  const std::size_t before = HeapBytes();
  ForgetHeapPeak();
  {
    const std::vector<char> block(1'000'000);
    EXPECT_GE(HeapBytes(), before + block.size());
  }
  EXPECT_LT(HeapBytes(), before + 100'000);
  EXPECT_GE(HeapPeakBytes(), before + 1'000'000);
  EXPECT_LT(HeapPeakBytes(), before + 1'100'000);
}

/// Bytes a pixel that ComputeDepth takes and gives back. In a thread of its own, so that what the
/// kernels keep for each thread is given back as well.
double TemporaryBytes(const Room& room, const DepthOptions& options) {
  Result<DepthResult> result = Fail(ErrorCode::kCancelled, "not run");
  AlignedSamples samples = room.samples;
  std::size_t peak = 0;
  ForgetHeapPeak();
  std::thread([&] {
    RunContext context;
    context.threads = 2;
    result = ComputeDepth(std::move(samples), room.guide, options, context);
    peak = HeapPeakBytes();
  }).join();
  EXPECT_TRUE(result);
  return static_cast<double>(peak - HeapBytes()) / (kWidth * kHeight);
}

class DepthMemory : public testing::TestWithParam<DepthMethod> {};

TEST_P(DepthMemory, IsAtMostFortyBytesAPixel) {
  const Room room = MakeRoom(kWidth, kHeight, 4, 12);
  const DepthOptions options = DefaultsOf(GetParam());
  TemporaryBytes(room, options);  // OpenCV's tables are made once
  const double bytes = TemporaryBytes(room, options);
  RecordProperty("bytes_a_pixel", std::to_string(bytes));
  EXPECT_LT(bytes, 40.0);
  EXPECT_GT(bytes, 0.5);  // something was counted
}

INSTANTIATE_TEST_SUITE_P(, DepthMemory,
                         testing::Values(DepthMethod::kForesight, DepthMethod::kPaper),
                         [](const auto& test) { return std::string(InfoOf(test.param).name); });

}  // namespace
}  // namespace foresight
