#include "hardware/motor/round_trips.h"

#include <algorithm>

#include "core/base/quantile.h"

namespace foresight {

void RoundTrips::Add(double sent_s, double answered_s) {
  sent_s_[count_ % kKept] = sent_s;
  duration_s_[count_ % kKept] = answered_s - sent_s;
  ++count_;
}

double RoundTrips::Median_s() const {
  if (count_ == 0) return 0.0;
  const auto end = duration_s_.begin() + static_cast<std::ptrdiff_t>(size());
  return UpperMedian(std::vector<double>(duration_s_.begin(), end));
}

void RoundTrips::Describe(MotorHealth& health) const {
  if (count_ == 0) return;
  health.round_trip_median_s = Median_s();
  health.round_trip_max_s = *std::max_element(
      duration_s_.begin(), duration_s_.begin() + static_cast<std::ptrdiff_t>(size()));
  // An idle motor is polled less often: the rate is that of the last second.
  const double newest_s = sent_s_[(count_ - 1) % kKept];
  std::size_t polls = 0;
  double oldest_s = newest_s;
  while (polls + 1 < size()) {
    const double sent_s = sent_s_[(count_ - 2 - polls) % kKept];
    if (newest_s - sent_s > 1.0) break;
    oldest_s = sent_s;
    ++polls;
  }
  if (polls > 0) health.poll_rate_hz = static_cast<double>(polls) / (newest_s - oldest_s);
}

}  // namespace foresight
