// What OpenCV's edge-preserving filters need for the same image. They take a dense map, so the
// holes are filled first; that is measured too. Beside the times are the errors against the room's
// truth.
#include <benchmark/benchmark.h>

#include <iostream>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/ximgproc.hpp>

#include "core/depth/depth_method.h"
#include "core/depth/sample_fill.h"
#include "tests/benchmark/accuracy.h"

namespace foresight {
namespace {

struct Input {
  cv::Mat guide;      ///< 8 bit
  cv::Mat guide_f32;  ///< likewise, as jointBilateralFilter wants the guide's depth to be the map's
  cv::Mat filled;     ///< metres
  cv::Mat confidence;  ///< 1 where a sample is
};

Room PaperRoom() {
  return MakeRoom(640, 480, 4, 12);
}

Input MakeInput() {
  const Room room = PaperRoom();
  const auto average = AverageByPixel(room.samples, room.guide);
  const DepthImage filled = FillSmoothly(*average);
  const GrayImage gray = ToGray(room.guide);
  const auto copy = [](const auto& image, int type) {
    cv::Mat mat(image.height(), image.width(), type);
    std::copy_n(image.data(), image.size(),
                mat.ptr<typename std::decay_t<decltype(image)>::Value>());
    return mat;
  };
  Input input;
  input.guide = copy(gray, CV_8U);
  input.guide.convertTo(input.guide_f32, CV_32F);
  input.filled = copy(filled, CV_32F);
  input.confidence = cv::Mat(copy(average->count, CV_32F) > 0.0f);
  input.confidence.convertTo(input.confidence, CV_32F, 1.0 / 255.0);
  return input;
}

void FillingHoles(benchmark::State& state) {
  const Room room = PaperRoom();
  DepthImage filled;
  for (auto _ : state) {
    const auto average = AverageByPixel(room.samples, room.guide);
    filled = FillSmoothly(*average);
  }
  ReportAccuracy(state, filled);
}

/// Our methods on the same samples, at their defaults, with what their masks keep and all pixels.
void RunOurs(benchmark::State& state, DepthMethod method) {
  const Room room = PaperRoom();
  RunContext context;
  context.threads = static_cast<int>(state.range(0));
  const DepthOptions options = DefaultsOf(method);
  Result<DepthResult> result = Fail(ErrorCode::kCancelled, "not run");
  for (auto _ : state) {
    result = ComputeDepth(room.samples, room.guide, options, context);
    if (!result) return state.SkipWithError(result.error().message.c_str());
  }
  ReportAccuracy(state, result->dense.depth_m);
  state.counters["a80_all_mm"] = state.counters["a80_mm"];
  state.counters["a95_all_mm"] = state.counters["a95_mm"];
  ReportAccuracy(state, result->dense.depth_m, result->mask);
}
void OurForesight(benchmark::State& state) {
  RunOurs(state, DepthMethod::kForesight);
}
void OurPaper(benchmark::State& state) {
  RunOurs(state, DepthMethod::kPaper);
}

/// Runs filter(input, output); the first argument is the number of threads.
template <class Filter>
void Measure(benchmark::State& state, const Filter& filter) {
  cv::setNumThreads(static_cast<int>(state.range(0)));
  const Input input = MakeInput();
  cv::Mat output;
  for (auto _ : state) {
    filter(input, output);
    benchmark::DoNotOptimize(output.data);
  }
  DepthImage depth_m(output.cols, output.rows);
  for (int y = 0; y < output.rows; ++y)
    std::copy_n(output.ptr<float>(y), output.cols, depth_m.row(y));
  ReportAccuracy(state, depth_m);
}

void JointBilateral(benchmark::State& state) {
  Measure(state, [](const Input& input, cv::Mat& output) {
    cv::ximgproc::jointBilateralFilter(input.guide_f32, input.filled, output, 41, 20.0, 20.0);
  });
}
void RollingGuidance(benchmark::State& state) {
  Measure(state, [](const Input& input, cv::Mat& output) {
    cv::ximgproc::rollingGuidanceFilter(input.filled, output, 41, 0.030, 20.0, 5);
  });
}
void Guided(benchmark::State& state) {
  Measure(state, [](const Input& input, cv::Mat& output) {
    cv::ximgproc::guidedFilter(input.guide, input.filled, output, 20, 400.0);
  });
}
void BilateralSolver(benchmark::State& state) {
  Measure(state, [](const Input& input, cv::Mat& output) {
    std::cout.setstate(std::ios::failbit);  // it prints its residual each time
    cv::ximgproc::fastBilateralSolverFilter(input.guide, input.filled, input.confidence, output);
    std::cout.clear();
  });
}

void TwoThreadCounts(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("threads")->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond);
  benchmark->MeasureProcessCPUTime();
}
BENCHMARK(FillingHoles)->Unit(benchmark::kMillisecond);
BENCHMARK(OurForesight)->Apply(TwoThreadCounts);
BENCHMARK(OurPaper)->Apply(TwoThreadCounts);
BENCHMARK(JointBilateral)->Apply(TwoThreadCounts);
BENCHMARK(RollingGuidance)->Apply(TwoThreadCounts);
BENCHMARK(Guided)->Apply(TwoThreadCounts);
BENCHMARK(BilateralSolver)->Apply(TwoThreadCounts);

}  // namespace
}  // namespace foresight
