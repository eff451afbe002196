#pragma once

#include "hardware/api/sensor_clock.h"

namespace foresight {

/// The clock of a head with real devices: the computer's steady clock, 0 when it is made. Safe from
/// any thread.
class RealTimeClock final : public SensorClock {
 public:
  double Now() const override;
  void Sleep(std::chrono::microseconds duration) override;

 private:
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace foresight
