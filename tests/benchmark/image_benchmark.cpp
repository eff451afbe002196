// One image of the emulated camera at its full size: CPU time of one thread, as the emulator has on
// a machine of two cores.
#include <benchmark/benchmark.h>

#include "core/simulation/world.h"

namespace foresight {
namespace {

void CaptureImage(benchmark::State& state, const char* scene_file) {
  auto scene = LoadScene(std::string(FORESIGHT_SOURCE_DIR "/resources/scenes/") + scene_file);
  if (!scene) return state.SkipWithError(scene.error().message.c_str());
  const World world(std::make_shared<const Scene>(std::move(*scene)), DefaultSensorRig(), {});
  RunContext context;
  context.threads = 1;
  for (auto _ : state) {
    const CameraFrame frame = world.CaptureImage(
        0, 0.0, 0.004, 0.0, [](double time_s) { return 0.17 * time_s; }, context);
    benchmark::DoNotOptimize(frame.image.values().data());
  }
}

BENCHMARK_CAPTURE(CaptureImage, room, "room.yaml")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(CaptureImage, valve, "valve.yaml")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace foresight
