#include "core/base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace foresight {
namespace {

TEST(ParallelFor, CallsEveryIndexOnce) {
  std::vector<std::atomic<int>> calls(1000);
  RunContext context;
  context.threads = 4;
  EXPECT_TRUE(ParallelFor(1000, context, [&](int i) { ++calls[static_cast<std::size_t>(i)]; }));
  for (const auto& count : calls) EXPECT_EQ(count, 1);
}

TEST(ParallelFor, HandsAnExceptionToTheCaller) {
  RunContext context;
  context.threads = 2;
  EXPECT_THROW(ParallelFor(100, context,
                           [](int i) {
                             if (i == 17) throw std::runtime_error("17");
                           }),
               std::runtime_error);
}

TEST(ParallelFor, StopsWhenCancelled) {
  std::stop_source stop;
  RunContext context;
  context.stop = stop.get_token();
  context.threads = 1;
  int calls = 0;
  EXPECT_FALSE(ParallelFor(1000, context, [&](int i) {
    ++calls;
    if (i == 9) stop.request_stop();
  }));
  EXPECT_EQ(calls, 10);
}

TEST(ParallelFor, OfNothingIsDone) {
  EXPECT_TRUE(ParallelFor(0, {}, [](int) { FAIL(); }));
}

TEST(RunContext, APartReportsIntoItsSliceOfTheBar) {
  Progress progress;
  RunContext context;
  context.progress = &progress;
  context.Part(0.5, 1.0).Part(0.0, 0.5).Report(1.0, "half of the second half");
  EXPECT_EQ(progress.permille, 750);
}

}  // namespace
}  // namespace foresight
