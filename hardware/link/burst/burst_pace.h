#pragma once

#include <algorithm>

namespace foresight {

/// Spreads what is sent evenly over time: at most `bytes_per_s`, and never more than `burst_bytes`
/// at once.
class BurstPace {
 public:
  BurstPace(double bytes_per_s, double burst_bytes)
      : bytes_per_s_(bytes_per_s), slack_s_(burst_bytes / bytes_per_s) {}

  /// So many bytes are to go: seconds to wait before they may. They count as sent.
  double Take(double bytes, double now_s) {
    // What was not used in time is lost, but for a burst.
    due_s_ = std::max(due_s_, now_s - slack_s_) + bytes / bytes_per_s_;
    return std::max(0.0, due_s_ - now_s);
  }

 private:
  const double bytes_per_s_;
  const double slack_s_;
  double due_s_ = -1e300;
};

/// How often a station may say what it has, on a return path that others use too.
class ReturnPace {
 public:
  /// The thinnest known path carries 9600 bit/s; acknowledgements take a quarter of it.
  static constexpr double kBytesPerS = 9600.0 / 8.0 / 4.0;
  /// Of what is around a message: HTTP/2, TLS, TCP and IP.
  static constexpr double kAroundBytes = 100.0;

  bool MaySend(double now_s) const { return now_s >= free_s_; }
  void Sent(double bytes, double now_s) { free_s_ = now_s + (bytes + kAroundBytes) / kBytesPerS; }

 private:
  double free_s_ = -1e300;
};

}  // namespace foresight
