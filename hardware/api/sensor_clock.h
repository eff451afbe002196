#pragma once

#include <chrono>

namespace foresight {

/// The one clock of a head. A simulated head may run it faster than the wall's.
class SensorClock {
 public:
  virtual ~SensorClock() = default;
  /// Seconds since the head was switched on.
  virtual double Now() const = 0;
  /// Lets the head's time pass.
  virtual void Sleep(std::chrono::microseconds duration) = 0;
};

}  // namespace foresight
