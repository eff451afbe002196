#pragma once

#include <array>
#include <cstddef>

#include "hardware/api/motor_health.h"

namespace foresight {

/// The last polls of a drive: how often, and how long each took. Not safe from many threads.
class RoundTrips {
 public:
  void Add(double sent_s, double answered_s);
  /// 0 while there are none.
  double Median_s() const;
  /// Fills in the rate and the round trips.
  void Describe(MotorHealth& health) const;
  void Clear() { count_ = 0; }

 private:
  static constexpr std::size_t kKept = 240;

  std::size_t size() const { return count_ < kKept ? count_ : kKept; }

  std::array<double, kKept> sent_s_{};
  std::array<double, kKept> duration_s_{};
  std::size_t count_ = 0;  ///< of all that were added
};

}  // namespace foresight
