#pragma once

#include <QCoreApplication>
#include <QObject>
#include <atomic>
#include <chrono>
#include <memory>
#include <thread>

namespace foresight {

/// Measures how long the GUI thread leaves an event waiting: a thread of its own posts one every 5
/// ms, and never a second one before the first was answered.
class StallMeter {
 public:
  StallMeter() : thread_([this](const std::stop_token& stop) { Watch(stop); }) {}

  double Worst_ms() const { return static_cast<double>(state_->worst_us.load()) / 1000.0; }

 private:
  using Clock = std::chrono::steady_clock;
  struct State {
    std::atomic<bool> waiting{false};
    std::atomic<std::int64_t> worst_us{0};
  };

  void Watch(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      if (!state_->waiting.exchange(true)) Post();
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }
  void Post() {
    QMetaObject::invokeMethod(
        QCoreApplication::instance(),
        [state = state_, posted = Clock::now()] {
          const auto late =
              std::chrono::duration_cast<std::chrono::microseconds>(Clock::now() - posted);
          if (late.count() > state->worst_us) state->worst_us = late.count();
          state->waiting = false;
        },
        Qt::QueuedConnection);
  }

  std::shared_ptr<State> state_ = std::make_shared<State>();
  std::jthread thread_;  ///< last: starts when everything else is there
};

}  // namespace foresight
