// The depth pipeline at the paper's own figure: 640 x 480, about 2 % of the pixels measured,
// sigma_s 20 px, five iterations after D0. The paper needs "less than a second" for it.
#include <benchmark/benchmark.h>

#include <cmath>

#include "core/base/random.h"
#include "core/depth/pipeline.h"
#include "tests/support/sample_grids.h"

namespace foresight {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;

/// A room-like depth: a slanted wall, a nearer box, noise of 10 mm.
AlignedSamples RoomSamples() {
  Random random(1);
  return SamplesOnLattice(kWidth, kHeight, 4, 12, [&](int u, int v) {
    const bool box = u > 220 && u < 420 && v > 160 && v < 380;
    return (box ? 1.2 : 2.0 + 0.001 * u) + 0.010 * random.Normal();
  });
}

ColorImage RoomGuide() {
  Random random(2);
  ColorImage guide(kWidth, kHeight);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) {
      const bool box = u > 220 && u < 420 && v > 160 && v < 380;
      const double value = (box ? 170.0 : 90.0) + 20.0 * std::sin(0.05 * u) + 4.0 * random.Normal();
      const auto level = static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0));
      guide(u, v) = {level, level, level};
    }
  return guide;
}

void DepthPipeline(benchmark::State& state) {
  const AlignedSamples samples = RoomSamples();
  const ColorImage guide = RoomGuide();
  DepthOptions options;
  options.upsample.sigma_spatial_px = 20.0;
  RunContext context;
  context.threads = static_cast<int>(state.range(0));
  for (auto _ : state) {
    auto result = ComputeDepth(samples, guide, options, context);
    if (!result) return state.SkipWithError(result.error().message.c_str());
    benchmark::DoNotOptimize(result);
  }
  state.counters["density"] = samples.Density();
}
BENCHMARK(DepthPipeline)
    ->Arg(1)
    ->Arg(2)
    ->ArgName("threads")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace foresight
