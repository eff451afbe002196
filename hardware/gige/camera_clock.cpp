#include "hardware/gige/camera_clock.h"

#include <algorithm>

#include "core/base/contract.h"

namespace foresight {
namespace {

struct Interval {
  explicit Interval(const CameraClock::Reading& reading)
      : low(reading.asked_s - reading.device_s), high(reading.answered_s - reading.device_s) {}
  double Width() const { return high - low; }

  double low;
  double high;
};

}  // namespace

CameraClock::CameraClock(std::span<const Reading> readings) {
  FORESIGHT_EXPECTS(!readings.empty(), "a clock is known from its readings");
  Interval common(readings.front());
  Interval narrowest = common;
  for (const Reading& reading : readings) {
    const Interval one(reading);
    common.low = std::max(common.low, one.low);
    common.high = std::min(common.high, one.high);
    if (one.Width() < narrowest.Width()) narrowest = one;
  }
  const Interval& best = common.Width() >= 0.0 ? common : narrowest;
  offset_s_ = 0.5 * (best.low + best.high);
  uncertainty_s_ = 0.5 * best.Width();
}

}  // namespace foresight
