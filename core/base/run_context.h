#pragma once

#include <atomic>
#include <stop_token>

namespace foresight {

/// Where a long call has got to. Workers write, anyone may read at any time; nothing blocks.
struct Progress {
  std::atomic<int> permille{0};
  std::atomic<const char*> stage{""};  ///< always a string literal
};

/// Last argument of every long call: how to stop it, where it reports, how many threads it may use.
struct RunContext {
  std::stop_token stop;
  Progress* progress = nullptr;
  int threads = 0;  ///< 0 = one per core

  /// The slice of the caller's progress bar that belongs to this call, in [0, 1].
  double begin = 0.0;
  double end = 1.0;

  bool Cancelled() const { return stop.stop_requested(); }

  /// Reports `fraction` in [0, 1] of this call's slice.
  void Report(double fraction, const char* stage) const {
    if (progress == nullptr) return;
    progress->stage.store(stage, std::memory_order_relaxed);
    progress->permille.store(static_cast<int>(1000.0 * (begin + (end - begin) * fraction)),
                             std::memory_order_relaxed);
  }

  /// A context for a part of this call that fills [from, to] of its bar.
  RunContext Part(double from, double to) const {
    RunContext part = *this;
    part.begin = begin + (end - begin) * from;
    part.end = begin + (end - begin) * to;
    return part;
  }
};

}  // namespace foresight
