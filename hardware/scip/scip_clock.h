#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>

namespace foresight {

/// Counts on where a 24-bit stamp of milliseconds wraps to 0, every 4 h 39 min 37 s. Between two
/// stamps lies less than half of that.
class StampUnwrapper {
 public:
  std::int64_t Unwrap(std::uint32_t stamp_ms);

 private:
  std::optional<std::int64_t> last_ms_;
};

/// One reading of the device's clock, on the head's clock.
struct ClockReading {
  double asked_s = 0.0;
  double answered_s = 0.0;
  std::uint32_t stamp_ms = 0;
};

/// Puts the stamps of a lidar's lines on the head's clock.
///
/// The offset comes from readings of the device's clock. Stamps are whole milliseconds, so each
/// line's time is that of a straight line through the last stamps: the mirror turns evenly. While
/// lines stream the clock cannot be read; then the earliest arrivals among the last lines tell how
/// far the device's clock has drifted since.
class ScipClock {
 public:
  explicit ScipClock(double period_s) : period_s_(period_s) {}

  /// `readings` are not empty.
  void Synchronise(std::span<const ClockReading> readings);

  struct LineTime {
    double time_s = 0.0;     ///< of the stamp, on the head's clock
    std::int64_t turns = 1;  ///< of the mirror since the line before, at least 1
  };
  /// `arrival_s`: when the first byte of the line came, on the head's clock.
  LineTime Place(std::uint32_t stamp_ms, double arrival_s);

  double offset_s() const { return offset_s_ + correction_s_; }
  double drift_ppm() const { return drift_ppm_; }
  double round_trip_s() const { return round_trip_s_; }
  double period_s() const { return period_s_; }

 private:
  struct Stamp {
    std::int64_t turn;
    double device_s;
  };

  double SmoothedStamp();
  void FollowDrift(double delay_s, double device_s);

  double period_s_;
  double offset_s_ = 0.0;  ///< head's clock minus device's at the last synchronisation
  double round_trip_s_ = 0.0;
  std::optional<double> synchronised_s_;
  StampUnwrapper unwrapper_;
  std::int64_t turn_ = 0;
  std::optional<double> last_line_s_;
  std::deque<Stamp> stamps_;

  std::deque<double> delays_s_;       ///< arrival - time by the offset, of the last lines
  std::optional<double> baseline_s_;  ///< the least delay right after the synchronisation
  double baseline_device_s_ = 0.0;
  double correction_s_ = 0.0;
  double drift_ppm_ = 0.0;
};

}  // namespace foresight
