#pragma once

#include <deque>
#include <string>

namespace foresight {

/// What can be wrong with one line of a stream.
enum class ScipLineTrouble { kNone, kBadSum, kWrongBeams, kBadStamp };

/// Remembers what was wrong with the lines of the last moments, so that an error can name what was
/// seen and not only what was missed. Pure; times do not decrease.
class ScipLineTroubles {
 public:
  static constexpr double kMemory_s = 1.5;

  /// `detail`, e.g. "1000 beams instead of 1081", is shown of the newest line.
  void Note(double time_s, ScipLineTrouble trouble, const std::string& detail);
  /// The most frequent trouble of the last kMemory_s, as a part of a sentence with what to do, e.g.
  /// "37 of 40 lines had a bad check sum in the last 1.5 s; check the cable"; empty when there was
  /// none.
  std::string Describe(double time_s) const;

 private:
  struct Line {
    double time_s;
    ScipLineTrouble trouble;
    std::string detail;
  };
  std::deque<Line> lines_;
};

}  // namespace foresight
