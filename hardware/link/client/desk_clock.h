#pragma once

#include <algorithm>
#include <deque>

namespace foresight {

/// What a clock at the far end shows now, from what it showed when messages left there. A message
/// may have waited on its way and never left before it was written: the largest difference of the
/// last ten minutes is the best one. Clocks that drift by 100 ppm go 60 ms apart in that time.
class DeskClock {
 public:
  static constexpr double kMemory_s = 600.0;

  /// `theirs` was read there before `ours` was read here. Times of one side do not decrease.
  void Add(double theirs_s, double ours_s) {
    while (!readings_.empty() && ours_s - readings_.front().ours_s > kMemory_s)
      readings_.pop_front();
    // A reading that is older and no better is never the best one again.
    while (!readings_.empty() && readings_.back().ahead_s <= theirs_s - ours_s)
      readings_.pop_back();
    readings_.push_back({ours_s, theirs_s - ours_s});
  }
  void Forget() { readings_.clear(); }
  bool Known() const { return !readings_.empty(); }
  /// At most so much later than the real one as it drifted, and at most the shortest way of a
  /// message earlier. @pre Known()
  double At(double ours_s) const { return ours_s + readings_.front().ahead_s; }

 private:
  struct Reading {
    double ours_s = 0.0;
    double ahead_s = 0.0;
  };
  std::deque<Reading> readings_;  ///< later ones are ahead less
};

}  // namespace foresight
