#pragma once

#include <pthread.h>

#include <QCoreApplication>
#include <QObject>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <ctime>
#include <memory>
#include <thread>
#include <utility>

namespace foresight {

/// How long the GUI thread left an event waiting.
struct Stall {
  double wall_ms = 0.0;
  double cpu_ms = 0.0;  ///< of the GUI thread itself: what a busy machine cannot inflate
};

/// Measures stalls of the thread that makes it: a thread of its own posts an event every 5 ms, and
/// never a second one before the first was answered.
class StallMeter {
 public:
  StallMeter() : thread_([this](const std::stop_token& stop) { Watch(stop); }) {}

  /// The longest wall and CPU times since the last call.
  Stall TakeWorst() { return std::exchange(state_->worst, {}); }

 private:
  using Clock = std::chrono::steady_clock;
  struct State {
    std::atomic<bool> waiting{false};
    Stall worst;  ///< touched by the GUI thread only
  };

  static double CpuTime_ms(clockid_t clock) {
    timespec time{};
    clock_gettime(clock, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
  }
  void Watch(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      if (!state_->waiting.exchange(true)) Post();
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }
  void Post() {
    QMetaObject::invokeMethod(
        QCoreApplication::instance(),
        [state = state_, clock = gui_clock_, posted = Clock::now(), cpu = CpuTime_ms(gui_clock_)] {
          const std::chrono::duration<double, std::milli> wall = Clock::now() - posted;
          state->worst.wall_ms = std::max(state->worst.wall_ms, wall.count());
          state->worst.cpu_ms = std::max(state->worst.cpu_ms, CpuTime_ms(clock) - cpu);
          state->waiting = false;
        },
        Qt::QueuedConnection);
  }
  static clockid_t ClockOfThisThread() {
    clockid_t clock{};
    pthread_getcpuclockid(pthread_self(), &clock);
    return clock;
  }

  clockid_t gui_clock_ = ClockOfThisThread();
  std::shared_ptr<State> state_ = std::make_shared<State>();
  std::jthread thread_;  ///< last: starts when everything else is there
};

}  // namespace foresight
