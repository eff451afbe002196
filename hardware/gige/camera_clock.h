#pragma once

#include <span>

namespace foresight {

/// What the head's clock says when a camera's clock says something.
///
/// Each reading was taken somewhere between question and answer, so the offset lies between
/// (asked - device) and (answered - device); the intervals of all readings are intersected and the
/// middle is taken. Off by at most uncertainty_s(), plus what the clocks drift until the next
/// reading (50 ppm: 0.1 ms in 2 s).
class CameraClock {
 public:
  struct Reading {
    double asked_s = 0.0;     ///< head's clock
    double answered_s = 0.0;  ///< head's clock
    double device_s = 0.0;    ///< device's clock, in between
  };

  CameraClock() = default;
  /// At least one reading, taken within a short time. Where they contradict each other (a clock has
  /// jumped) the one with the shortest round trip decides.
  explicit CameraClock(std::span<const Reading> readings);

  double ToHead(double device_s) const { return device_s + offset_s_; }
  double offset_s() const { return offset_s_; }
  double uncertainty_s() const { return uncertainty_s_; }

 private:
  double offset_s_ = 0.0;
  double uncertainty_s_ = 0.0;
};

}  // namespace foresight
