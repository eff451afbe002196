#include "hardware/simulated/simulated_clock.h"

#include <algorithm>
#include <thread>

namespace foresight {

SimulatedClock::SimulatedClock(SimulationSpeed speed)
    : speed_(speed), start_(std::chrono::steady_clock::now()) {}

double SimulatedClock::Now() const {
  if (speed_ == SimulationSpeed::kRealTime)
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const std::lock_guard lock(mutex_);
  return simulated_s_;
}

void SimulatedClock::Sleep(std::chrono::microseconds duration) {
  if (speed_ == SimulationSpeed::kRealTime) {
    std::this_thread::sleep_for(duration);
    return;
  }
  const std::lock_guard lock(mutex_);
  simulated_s_ += std::chrono::duration<double>(duration).count();
}

void SimulatedClock::WaitUntil(double time_s) {
  if (speed_ == SimulationSpeed::kRealTime) {
    std::this_thread::sleep_until(start_ + std::chrono::duration_cast<std::chrono::nanoseconds>(
                                               std::chrono::duration<double>(time_s)));
    return;
  }
  const std::lock_guard lock(mutex_);
  simulated_s_ = std::max(simulated_s_, time_s);
}

}  // namespace foresight
