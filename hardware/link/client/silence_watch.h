#pragma once

#include <algorithm>
#include <utility>

namespace foresight {

/// Decides when the silence of a head that has more to send is the connection's. A head that is
/// slow is doubted once: then the watch waits longer, until a silence was a blackout after all.
/// Before the first word of a stream a head may be reading a large scan from its disk.
/// Times are in seconds of one clock.
class SilenceWatch {
 public:
  static constexpr double kShortest_s = 0.3;
  static constexpr double kLongest_s = 2.4;
  /// Where a fresh connection is there sooner, the path was open and the head was slow.
  static constexpr double kDark_s = 0.1;

  /// A stream begins.
  void Begin(double now_s) {
    if (doubted_ && now_s - doubted_s_ >= kDark_s) patience_s_ = kShortest_s;
    Heard(now_s);
    spoke_ = false;
  }

  /// Something came, or there is nothing to come. Returns whether that ends a doubt.
  bool Heard(double now_s) {
    heard_s_ = now_s;
    spoke_ = true;
    return std::exchange(doubted_, false);
  }

  /// Nothing came. True once a silence, when the connection is to be doubted.
  bool Doubts(double now_s, double round_trip_s) {
    const double patience_s = spoke_ ? patience_s_ : kLongest_s;
    if (doubted_ || now_s - heard_s_ <= patience_s + round_trip_s) return false;
    doubted_ = true;
    doubted_s_ = now_s;
    if (spoke_) patience_s_ = std::min(2.0 * patience_s_, kLongest_s);
    return true;
  }

 private:
  double patience_s_ = kShortest_s;
  double heard_s_ = 0.0;
  double doubted_s_ = 0.0;
  bool doubted_ = false;
  bool spoke_ = false;  ///< in this stream
};

}  // namespace foresight
