#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace foresight {

/// Tells which time stamps of a lidar cannot be true: its mirror turns evenly and a line comes
/// after it was measured. What is late may have waited on the network, until all that comes is late
/// for longer than a network holds bytes back. Pure.
class ScipStampWatch {
 public:
  /// A stamp may lie so far in the future: the clock is known to some milliseconds.
  static constexpr double kAhead_s = 0.05;
  /// Lines may be late by so much, and for so long.
  static constexpr double kLate_s = 0.25;
  static constexpr double kLateFor_s = 0.5;

  /// More than this is no network's doing.
  static constexpr double kTooLate_s = 1.5;

  /// The device's clock was read: `device_ms`, counted on where 24 bits wrap.
  void Reset(std::int64_t device_ms);
  /// What is wrong with a line's stamp, to follow "time stamps "; nullopt when it is believed.
  /// `offset_s` is the head's clock minus the device's, whose milliseconds count on from Reset.
  std::optional<std::string> Check(std::uint32_t stamp_ms, double arrival_s, double offset_s);

 private:
  std::optional<std::int64_t> last_ms_;  ///< believed, counted on where it wraps
  bool of_line_ = false;                 ///< last_ms_ is that of a line
  std::optional<double> late_since_s_;
};

}  // namespace foresight
