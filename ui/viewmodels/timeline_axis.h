#pragma once

#include <QString>
#include <cstdint>
#include <vector>

namespace foresight {

/// Which part of a timeline is in sight, and where times lie on the screen. Times are UTC in
/// nanoseconds, x is in pixels from the left edge of the axis.
class TimelineAxis {
 public:
  struct Tick {
    double x = 0.0;
    QString text;  ///< local time
  };

  /// What there is to see. All of it is in sight then.
  void SetLimits(std::int64_t begin_utc_ns, std::int64_t end_utc_ns);
  /// The same, but what is in sight stays as far as it can: more has come.
  void Extend(std::int64_t begin_utc_ns, std::int64_t end_utc_ns);
  void SetWidth(double width_px);
  double Width() const { return width_px_; }

  std::int64_t Begin() const { return begin_utc_ns_; }  ///< of what is in sight
  std::int64_t End() const { return end_utc_ns_; }
  bool ShowsAll() const;

  double XOf(std::int64_t utc_ns) const;
  std::int64_t TimeAt(double x) const;

  /// Closer by `factor` (below 1: farther); the time at x stays there, as far as the limits allow.
  void ZoomAt(double x, double factor);
  /// Moves what is in sight: to later times where `px` is positive.
  void PanBy(double px);
  void ShowAll();
  /// Just this, as far as the limits allow.
  void ShowSpan(std::int64_t begin_utc_ns, std::int64_t end_utc_ns);
  /// Moves what is in sight as little as needed for the time to be seen.
  void BringIntoSight(std::int64_t utc_ns);

  /// Round times, at least `apart_px` from each other.
  std::vector<Tick> Ticks(double apart_px) const;

  static constexpr std::int64_t kShortest_ns = 20'000'000;

 private:
  void MoveTo(std::int64_t begin_utc_ns, std::int64_t span_ns);

  std::int64_t first_utc_ns_ = 0, last_utc_ns_ = kShortest_ns;  ///< the limits
  std::int64_t begin_utc_ns_ = 0, end_utc_ns_ = kShortest_ns;   ///< what is in sight
  double width_px_ = 1.0;
};

}  // namespace foresight
