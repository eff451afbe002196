#pragma once

#include <mutex>

#include "hardware/api/sensor_clock.h"

namespace foresight {

enum class SimulationSpeed {
  kRealTime,          ///< a second of the head takes a second
  kAsFastAsPossible,  ///< time passes only where somebody waits for it: a Sleep or a device
};

/// The clock of a simulated head; 0 when it is made. Safe from any thread.
class SimulatedClock final : public SensorClock {
 public:
  explicit SimulatedClock(SimulationSpeed speed);

  SimulationSpeed speed() const { return speed_; }
  double Now() const override;
  void Sleep(std::chrono::microseconds duration) override;
  /// Lets time pass until `time_s`; returns at once when that is over.
  void WaitUntil(double time_s);

 private:
  const SimulationSpeed speed_;
  const std::chrono::steady_clock::time_point start_;
  mutable std::mutex mutex_;
  double simulated_s_ = 0.0;
};

}  // namespace foresight
