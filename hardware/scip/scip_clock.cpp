#include "hardware/scip/scip_clock.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace foresight {
namespace {

constexpr double kTick_s = 1e-3;  // of the stamps
/// Lines that the straight line goes through, and among which the earliest arrival is sought: 2 s.
constexpr std::size_t kWindow = 80;
/// Lines after which the straight line is good to a tenth of a tick, and delays mean something.
constexpr std::size_t kSettledLines = 40;
/// Delays among which the least is the connection's.
constexpr std::size_t kBaselineLines = 40;
/// Weight of the known period against the stamps: (0.29 ms of rounding / 0.1 ms)^2.
constexpr double kPeriodWeight = 8.0;
/// No quartz drifts faster. A longer delay of the network must not pass for one.
constexpr double kFastestDrift = 500e-6;
/// The fraction of a new estimate that is taken over a line: jumps become ramps of half a second.
constexpr double kFollow = 0.05;
/// Drift is a quotient; over less time the stamps' rounding is most of it.
constexpr double kDriftAfter_s = 3.0;

}  // namespace

std::int64_t StampUnwrapper::Unwrap(std::uint32_t stamp_ms) {
  if (!last_ms_) {
    last_ms_ = stamp_ms & 0xFFFFFF;
    return *last_ms_;
  }
  const std::int64_t difference = (stamp_ms - *last_ms_) & 0xFFFFFF;
  *last_ms_ += difference < 0x800000 ? difference : difference - 0x1000000;
  return *last_ms_;
}

void ScipClock::Synchronise(std::span<const ClockReading> readings) {
  // A stamp is rounded down and was taken between question and answer, so the offset lies between
  // (asked - stamp - 1 ms) and (answered - stamp). All readings together leave hardly more than the
  // shortest round trip, and its middle is the best guess.
  StampUnwrapper unwrapper;
  double least_s = -std::numeric_limits<double>::infinity();
  double most_s = std::numeric_limits<double>::infinity();
  round_trip_s_ = most_s;
  for (const ClockReading& reading : readings) {
    const double device_s = kTick_s * static_cast<double>(unwrapper.Unwrap(reading.stamp_ms));
    least_s = std::max(least_s, reading.asked_s - device_s - kTick_s);
    most_s = std::min(most_s, reading.answered_s - device_s);
    round_trip_s_ = std::min(round_trip_s_, reading.answered_s - reading.asked_s);
  }
  const double offset_s = 0.5 * (least_s + most_s);
  const double middle_s = 0.5 * (readings.front().asked_s + readings.back().answered_s);
  if (synchronised_s_ && middle_s - *synchronised_s_ > kDriftAfter_s) {
    const double drift = (offset_s - offset_s_) / (middle_s - *synchronised_s_);
    // Else the device's clock was set back, or wrapped.
    if (std::abs(drift) < kFastestDrift) drift_ppm_ = 1e6 * drift;
  }
  offset_s_ = offset_s;
  synchronised_s_ = middle_s;
  unwrapper_ = unwrapper;
  stamps_.clear();
  delays_s_.clear();
  baseline_s_.reset();
  correction_s_ = 0.0;
}

ScipClock::LineTime ScipClock::Place(std::uint32_t stamp_ms, double arrival_s) {
  const double device_s = kTick_s * static_cast<double>(unwrapper_.Unwrap(stamp_ms));
  const double rough_s = device_s + offset_s();
  LineTime line;
  if (last_line_s_)
    line.turns = std::max<std::int64_t>(1, std::llround((rough_s - *last_line_s_) / period_s_));
  last_line_s_ = rough_s;
  turn_ += line.turns;
  // Over a longer silence the turns are no longer known for sure.
  if (line.turns > static_cast<std::int64_t>(kWindow)) stamps_.clear();
  stamps_.push_back({turn_, device_s});
  if (stamps_.size() > kWindow) stamps_.pop_front();

  const double smoothed_s = SmoothedStamp();
  if (stamps_.size() >= kSettledLines)
    FollowDrift(arrival_s - (smoothed_s + offset_s_), smoothed_s);
  line.time_s = smoothed_s + offset_s();
  return line;
}

/// The newest stamp on the line through the last ones, in the middle of its tick.
double ScipClock::SmoothedStamp() {
  const Stamp& newest = stamps_.back();
  double turns = 0.0;
  double seconds = 0.0;
  for (const Stamp& stamp : stamps_) {
    turns += static_cast<double>(stamp.turn - newest.turn);
    seconds += stamp.device_s - newest.device_s;
  }
  const auto n = static_cast<double>(stamps_.size());
  turns /= n;
  seconds /= n;
  double spread = kPeriodWeight;
  double product = kPeriodWeight * period_s_;
  for (const Stamp& stamp : stamps_) {
    const double turn = static_cast<double>(stamp.turn - newest.turn) - turns;
    spread += turn * turn;
    product += turn * (stamp.device_s - newest.device_s - seconds);
  }
  const double period_s = product / spread;
  if (stamps_.size() == kWindow) period_s_ = period_s;
  return newest.device_s + seconds - turns * period_s + 0.5 * kTick_s;
}

void ScipClock::FollowDrift(double delay_s, double device_s) {
  delays_s_.push_back(delay_s);
  if (delays_s_.size() > kWindow) delays_s_.pop_front();
  const double least_s = *std::min_element(delays_s_.begin(), delays_s_.end());
  if (!baseline_s_) {
    if (delays_s_.size() < kBaselineLines) return;
    baseline_s_ = least_s;
    baseline_device_s_ = device_s;
  }
  const double step_s = kFollow * (least_s - *baseline_s_ - correction_s_);
  const double most_s = kFastestDrift * period_s_;
  correction_s_ += std::clamp(step_s, -most_s, most_s);
  if (const double elapsed_s = device_s - baseline_device_s_; elapsed_s > kDriftAfter_s)
    drift_ppm_ = 1e6 * correction_s_ / elapsed_s;
}

}  // namespace foresight
