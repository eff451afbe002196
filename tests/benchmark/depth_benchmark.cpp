// The depth pipeline at the paper's own figure: 640 x 480, about 2 % of the pixels measured,
// sigma_s 20 px, five iterations after D0. The paper needs "less than a second" for it. "CPU" is
// that of all threads: it is the column to read when others use the machine.
#include <benchmark/benchmark.h>

#include <string>

#include "core/base/parallel.h"
#include "core/depth/depth_method.h"
#include "tests/benchmark/accuracy.h"
#include "tests/benchmark/plane_input.h"
#include "tests/support/vector_targets.h"

namespace foresight {
namespace {

struct Setting {
  const char* name;
  int width, height;
  int step_u, step_v;
  double sigma_px;
};
constexpr Setting kPaper{"640x480/2%", 640, 480, 4, 12, 20.0};
constexpr Setting kDense{"640x480/5%", 640, 480, 4, 5, 15.0};
constexpr Setting kCamera{"1288x964/2%", 1288, 964, 4, 12, 20.0};

Room RoomOf(const Setting& setting) {
  return MakeRoom(setting.width, setting.height, setting.step_u, setting.step_v);
}

RunContext Threads(int count) {
  RunContext context;
  context.threads = count;
  return context;
}

/// Pairs of a pixel and a sample in its disc.
double CountPairs(const AlignedSamples& samples, double radius_px) {
  const int radius = static_cast<int>(radius_px);
  double pairs = 0.0;
  for (const AlignedSample& s : samples.samples)
    for (int dy = -radius; dy <= radius; ++dy) {
      const int y = static_cast<int>(std::lround(s.v)) + dy;
      if (y < 0 || y >= samples.height) continue;
      const int half = static_cast<int>(std::sqrt(radius_px * radius_px - dy * dy));
      const int x = static_cast<int>(std::lround(s.u));
      pairs += std::min(x + half, samples.width - 1) - std::max(x - half, 0) + 1;
    }
  return pairs;
}

/// CPU time for one weight of one pass.
void ReportWeights(benchmark::State& state, double weights) {
  state.counters["per_weight"] = benchmark::Counter(
      weights, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// The paper's method, everything from aligned samples to the mask.
void Paper(benchmark::State& state, const Setting& setting, int64_t target, int threads) {
  const OnlyVectorTarget only(target);
  const Room room = RoomOf(setting);
  DepthOptions options;
  options.upsample.sigma_spatial_px = setting.sigma_px;
  // All samples stay, so that the number of weights is known.
  options.flying.threshold_m = 10.0;
  options.isolated.enabled = false;
  for (auto _ : state) {
    auto result = ComputeDepth(room.samples, room.guide, options, Threads(threads));
    if (!result) return state.SkipWithError(result.error().message.c_str());
    benchmark::DoNotOptimize(result);
  }
  ReportWeights(state, 6.0 * CountPairs(room.samples, setting.sigma_px));
}

/// Foresight's own method, everything from aligned samples to the mask, with errors of what it
/// keeps.
void RunForesight(benchmark::State& state, const Setting& setting, int64_t target, int threads,
                  const DepthOptions& options) {
  const OnlyVectorTarget only(target);
  const Room room = RoomOf(setting);
  Result<DepthResult> result = Fail(ErrorCode::kCancelled, "not run");
  for (auto _ : state) {
    result = ComputeDepth(room.samples, room.guide, options, Threads(threads));
    if (!result) return state.SkipWithError(result.error().message.c_str());
  }
  ReportAccuracy(state, result->dense.depth_m, result->mask);
}

/// At the setting that the paper's figure is quoted for.
void Foresight(benchmark::State& state, const Setting& setting, int64_t target, int threads) {
  DepthOptions options = DefaultsOf(DepthMethod::kForesight);
  options.local_plane.sigma_spatial_px = setting.sigma_px;
  options.local_plane.radius_in_sigmas = 1.0;
  options.local_plane.iterations = 5;
  RunForesight(state, setting, target, threads, options);
}
void ForesightDefaults(benchmark::State& state, const Setting& setting, int64_t target,
                       int threads) {
  RunForesight(state, setting, target, threads, DefaultsOf(DepthMethod::kForesight));
}

/// Its stages one by one, with a disc of radius sigma_s. First the planes of the samples: eight
/// candidates, four passes.
void SamplePlanes(benchmark::State& state, const Setting& setting, int64_t target, int threads) {
  const OnlyVectorTarget only(target);
  PlaneInput input(RoomOf(setting), setting.sigma_px);
  for (auto _ : state) {
    input.FitPlanes(Threads(threads));
    benchmark::DoNotOptimize(input.planes().data());
  }
}

void Cells(benchmark::State& state, const Setting& setting, int64_t target, int threads) {
  const OnlyVectorTarget only(target);
  PlaneInput input(RoomOf(setting), setting.sigma_px);
  input.FitPlanes(Threads(threads));
  for (auto _ : state) benchmark::DoNotOptimize(input.InsideCells(Threads(threads)));
}

/// The pixels' planes: a start and five passes.
void Planes(benchmark::State& state, const Setting& setting, int64_t target, int threads) {
  const OnlyVectorTarget only(target);
  PlaneInput input(RoomOf(setting), setting.sigma_px);
  input.FitPlanes(Threads(threads));
  for (auto _ : state) {
    input.ForEachBlock(Threads(threads), [&](int top, int bottom) {
      PlaneBlock block(setting.width);
      FilterPlaneRows(input.filter(5), top, bottom, block.Output());
      benchmark::DoNotOptimize(block.depth_m.data());
    });
  }
  ReportWeights(state, 6.0 * CountPairs(input.samples(), setting.sigma_px));
}

/// The confidence of planes that are there already.
void Support(benchmark::State& state, const Setting& setting, int64_t target, int threads) {
  const OnlyVectorTarget only(target);
  PlaneInput input(RoomOf(setting), setting.sigma_px);
  input.FitPlanes(Threads(threads));
  const MaskImage inside = *input.InsideCells(Threads(threads));
  std::vector<PlaneBlock> blocks;
  for (int top = 0; top < setting.height; top += PlaneInput::kBlockRows) {
    blocks.emplace_back(setting.width);
    FilterPlaneRows(input.filter(5), top, std::min(top + PlaneInput::kBlockRows, setting.height),
                    blocks.back().Output());
  }
  FloatImage confidence(setting.width, setting.height);
  const SupportModel model = input.Support();
  for (auto _ : state) {
    input.ForEachBlock(Threads(threads), [&](int top, int bottom) {
      const PlaneBlock& block = blocks[static_cast<std::size_t>(top / PlaneInput::kBlockRows)];
      for (int y = top; y < bottom; ++y)
        MeasureSupport(model, y, block.Row(y - top, inside.row(y)), confidence.row(y));
    });
    benchmark::DoNotOptimize(confidence.data());
  }
}

/// The stages around the filter, one by one.
template <class Stage>
void MeasureRejection(benchmark::State& state, const Stage& stage) {
  const Room room = RoomOf(kPaper);
  for (auto _ : state) {
    AlignedSamples samples = room.samples;
    if (!stage(samples)) return state.SkipWithError("the stage failed");
    benchmark::DoNotOptimize(samples);
  }
}
void Flying(benchmark::State& state) {
  MeasureRejection(state, [](auto& samples) { return RejectFlying(samples, {}); });
}
void Isolated(benchmark::State& state) {
  MeasureRejection(state, [](auto& samples) { return RejectIsolated(samples, {}); });
}
void Flipping(benchmark::State& state) {
  MeasureRejection(state, [](auto& samples) { return RejectFlipping(samples, {}, Threads(1)); });
}
void SortingSamples(benchmark::State& state) {
  const Room room = RoomOf(kPaper);
  for (auto _ : state) {
    const SparseDepthMap sparse(room.samples);
    benchmark::DoNotOptimize(sparse.size());
  }
}
void Gray(benchmark::State& state) {
  const Room room = RoomOf(kPaper);
  for (auto _ : state) benchmark::DoNotOptimize(ToGray(room.guide));
}
void Masking(benchmark::State& state) {
  const Room room = RoomOf(kPaper);
  UpsampleOptions options;
  options.sigma_spatial_px = 20.0;
  const auto dense = UpsampleDepth(room.samples, room.guide, options, {});
  for (auto _ : state) benchmark::DoNotOptimize(MaskLowConfidence(*dense, {}));
}
BENCHMARK(Flying)->Unit(benchmark::kMillisecond);
BENCHMARK(Isolated)->Unit(benchmark::kMillisecond);
BENCHMARK(Flipping)->Unit(benchmark::kMillisecond);
BENCHMARK(SortingSamples)->Unit(benchmark::kMillisecond);
BENCHMARK(Gray)->Unit(benchmark::kMillisecond);
BENCHMARK(Masking)->Unit(benchmark::kMillisecond);

using Measured = void (*)(benchmark::State&, const Setting&, int64_t, int);

void Register(const char* what, Measured measured, const Setting& setting, int64_t target,
              int threads) {
  const std::string name = std::string(what) + "/" + setting.name + "/" + hwy::TargetName(target) +
                           "/" + std::to_string(threads) + "_threads";
  benchmark::RegisterBenchmark(name.c_str(), measured, setting, target, threads)
      ->Unit(benchmark::kMillisecond)
      ->MeasureProcessCPUTime();
}

/// One and two threads at the paper's setting on every instruction set; the others on the best.
const bool registered = [] {
  for (const auto& [what, measured] : {std::pair<const char*, Measured>{"Paper", &Paper},
                                       {"Foresight", &Foresight},
                                       {"ForesightDefaults", &ForesightDefaults},
                                       {"Planes", &Planes},
                                       {"SamplePlanes", &SamplePlanes},
                                       {"Cells", &Cells},
                                       {"Support", &Support}}) {
    for (const int64_t target : VectorTargets())
      for (const int threads : {1, 2}) Register(what, measured, kPaper, target, threads);
    for (const Setting& setting : {kDense, kCamera})
      for (const int threads : {1, 2})
        Register(what, measured, setting, VectorTargets().front(), threads);
  }
  return true;
}();

}  // namespace
}  // namespace foresight
