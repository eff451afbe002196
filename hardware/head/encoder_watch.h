#pragma once

#include <optional>
#include <string>

#include "core/geometry/angles.h"
#include "core/sensor/motor_track.h"

namespace foresight {

/// Tells when an encoder says what the motor cannot have done: a step or a way faster than it was
/// commanded, or a way back. A drive that lost counts, or a damaged encoder, would otherwise bend
/// the scan or end it early, and nobody would know. Pure; samples come in time order.
class EncoderWatch {
 public:
  /// Allowed beyond the commanded motion: encoder steps, play of the gear, a ramp that overshoots.
  static constexpr double kTolerance_rad = RadiansFromDegrees(0.5);
  /// How wrong the time of one sample may be: half a slow round trip on a busy machine.
  static constexpr double kTiming_s = 0.01;
  /// Drives overshoot their speed a little.
  static constexpr double kSpeedFactor = 1.25;

  /// The motor may turn either way, at most at `speed_rad_s`, until something else is expected.
  void ExpectAnyMotion(double speed_rad_s);
  /// From rest the motor turns at most at `speed_rad_s`, upwards for a positive `sign`, downwards
  /// for a negative one.
  void ExpectMotion(double sign, double speed_rad_s);
  /// The next sample is believed: the encoder counts from a new zero.
  void Forget();

  /// What is impossible about `sample`, in one sentence with its values; nullopt when it is
  /// possible. A sample whose time does not increase is ignored, as MotorTrack::Add does.
  std::optional<std::string> Check(const MotorSample& sample);

 private:
  std::optional<std::string> CheckStep(const MotorSample& sample) const;
  std::optional<std::string> CheckWay(const MotorSample& sample) const;

  double speed_rad_s_ = 0.0;
  double sign_ = 0.0;                 ///< 0: either way
  std::optional<MotorSample> last_;   ///< believed
  std::optional<MotorSample> first_;  ///< of the expected motion
  double furthest_rad_ = 0.0;         ///< along the expected motion
};

}  // namespace foresight
