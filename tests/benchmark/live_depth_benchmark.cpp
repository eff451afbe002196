// What four new lines cost while the head sweeps at 10 deg/s, against doing all again: CPU time of
// one thread, as the live map uses it. The sweep is half way, at the middle of the image.
#include <benchmark/benchmark.h>

#include "core/depth/depth_method.h"
#include "core/depth/live_depth.h"
#include "tests/support/growing_scan.h"

namespace foresight {
namespace {

constexpr int kLinesBefore = 120;
constexpr int kNewLines = 4;

struct Sweep {
  SensorRig rig;
  CameraFrame frame;
  ScanPlan plan;
  RegisteredScan before;
  RegisteredScan now;
};

/// Made once a size: the image alone takes a second.
const Sweep& SweepWithImage(bool full_size) {
  const auto make = [](int width, int height) {
    Scan scan =
        samples::SweepOverRoom(samples::RigWithImage(width, height), RadiansFromDegrees(10.0));
    return Sweep{scan.rig, scan.frames[0], scan.plan, samples::RegisteredAfter(scan, kLinesBefore),
                 samples::RegisteredAfter(scan, kLinesBefore + kNewLines)};
  };
  static const Sweep half = make(640, 482);
  if (!full_size) return half;
  static const Sweep full = make(1288, 964);
  return full;
}

RunContext OneThread() {
  RunContext context;
  context.threads = 1;
  return context;
}

void Whole(benchmark::State& state, DepthMethod method, bool full_size) {
  const Sweep& sweep = SweepWithImage(full_size);
  const DepthOptions options = *FixedForPlan(DefaultsOf(method), sweep.plan, sweep.rig);
  for (auto _ : state) {
    const auto depth = ComputeDepthInFrame(sweep.now, sweep.rig, sweep.frame, options, OneThread());
    if (!depth) return state.SkipWithError(depth.error().message.c_str());
  }
}

void FourMoreLines(benchmark::State& state, DepthMethod method, bool full_size) {
  const Sweep& sweep = SweepWithImage(full_size);
  LiveDepth live(sweep.rig, sweep.frame, *FixedForPlan(DefaultsOf(method), sweep.plan, sweep.rig));
  for (auto _ : state) {
    state.PauseTiming();
    const bool ready = live.Update(sweep.before, OneThread()).has_value();
    state.ResumeTiming();
    const auto depth = live.Update(sweep.now, OneThread());
    if (!ready || !depth) return state.SkipWithError("the update failed");
  }
  state.counters["rows"] = live.filtered_rows();
}

const bool registered = [] {
  for (const DepthMethod method : {DepthMethod::kForesight, DepthMethod::kPaper})
    for (const bool full_size : {false, true}) {
      const std::string setting =
          std::string("/") + InfoOf(method).name + (full_size ? "/1288x964" : "/640x482");
      benchmark::RegisterBenchmark(("LiveWhole" + setting).c_str(), Whole, method, full_size)
          ->Unit(benchmark::kMillisecond);
      benchmark::RegisterBenchmark(("LiveFourMoreLines" + setting).c_str(), FourMoreLines, method,
                                   full_size)
          ->Unit(benchmark::kMillisecond);
    }
  return true;
}();

}  // namespace
}  // namespace foresight
