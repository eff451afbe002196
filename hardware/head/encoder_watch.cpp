#include "hardware/head/encoder_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/geometry/angles.h"

namespace foresight {

void EncoderWatch::ExpectAnyMotion(double speed_rad_s) {
  speed_rad_s_ = speed_rad_s;
  sign_ = 0.0;
  first_.reset();
}

void EncoderWatch::ExpectMotion(double sign, double speed_rad_s) {
  speed_rad_s_ = speed_rad_s;
  sign_ = sign > 0.0 ? 1.0 : -1.0;
  first_ = last_;
  if (last_) furthest_rad_ = last_->angle_rad;
}

void EncoderWatch::Forget() {
  last_.reset();
  first_.reset();
}

std::optional<std::string> EncoderWatch::Check(const MotorSample& sample) {
  if (last_ && !(sample.time_s > last_->time_s)) return std::nullopt;
  if (const auto impossible = CheckStep(sample)) return impossible;
  if (const auto impossible = CheckWay(sample)) return impossible;
  last_ = sample;
  if (sign_ != 0.0) {
    if (!first_) {
      first_ = sample;
      furthest_rad_ = sample.angle_rad;
    }
    furthest_rad_ = sign_ * std::max(sign_ * furthest_rad_, sign_ * sample.angle_rad);
  }
  return std::nullopt;
}

std::optional<std::string> EncoderWatch::CheckStep(const MotorSample& sample) const {
  if (!last_) return std::nullopt;
  const double elapsed_s = sample.time_s - last_->time_s;
  const double way_rad = std::abs(sample.angle_rad - last_->angle_rad);
  const double possible_rad =
      kSpeedFactor * speed_rad_s_ * (elapsed_s + kTiming_s) + kTolerance_rad;
  if (way_rad <= possible_rad) return std::nullopt;
  return fmt::format(
      "its encoder jumped from {:.2f} to {:.2f} deg within {:.1f} ms; {:.2f} deg are possible at "
      "the commanded {:.1f} deg/s",
      DegreesFromRadians(last_->angle_rad), DegreesFromRadians(sample.angle_rad), 1e3 * elapsed_s,
      DegreesFromRadians(possible_rad), DegreesFromRadians(speed_rad_s_));
}

std::optional<std::string> EncoderWatch::CheckWay(const MotorSample& sample) const {
  if (!first_ || sign_ == 0.0) return std::nullopt;
  const double back_rad = sign_ * (furthest_rad_ - sample.angle_rad);
  if (back_rad > kTolerance_rad)
    return fmt::format(
        "its encoder ran back from {:.2f} to {:.2f} deg while the motor was commanded {}",
        DegreesFromRadians(furthest_rad_), DegreesFromRadians(sample.angle_rad),
        sign_ > 0.0 ? "upwards" : "downwards");
  const double elapsed_s = sample.time_s - first_->time_s;
  const double way_rad = std::abs(sample.angle_rad - first_->angle_rad);
  if (way_rad <= kSpeedFactor * speed_rad_s_ * (elapsed_s + kTiming_s) + kTolerance_rad)
    return std::nullopt;
  return fmt::format(
      "its encoder went {:.2f} deg in {:.2f} s, which is faster than the commanded {:.1f} deg/s",
      DegreesFromRadians(way_rad), elapsed_s, DegreesFromRadians(speed_rad_s_));
}

}  // namespace foresight
