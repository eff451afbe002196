#pragma once

#include <benchmark/benchmark.h>

#include "core/evaluation/depth_accuracy.h"
#include "tests/benchmark/room.h"

namespace foresight {

/// Counters with the errors of a map of MakeRoom's room: A80, A95 and the fraction of pixels it
/// keeps.
inline void ReportAccuracy(benchmark::State& state, const DepthImage& depth_m,
                           const MaskImage& mask) {
  const auto score = ScoreDepth(depth_m, mask, TrueRoom(depth_m.width(), depth_m.height()), 1);
  if (!score) return state.SkipWithError(score.error().message.c_str());
  state.counters["a80_mm"] = score->a80_mm;
  state.counters["a95_mm"] = score->a95_mm;
  state.counters["kept"] = score->coverage;
}

/// Of a map that keeps every pixel.
inline void ReportAccuracy(benchmark::State& state, const DepthImage& depth_m) {
  ReportAccuracy(state, depth_m, MaskImage(depth_m.width(), depth_m.height(), 255));
}

}  // namespace foresight
