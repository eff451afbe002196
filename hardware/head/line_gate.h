#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "core/sensor/lidar_line.h"
#include "core/sensor/motor_track.h"

namespace foresight {

/// Picks the lines of a sweep that belong to its scope: those whose beams all lie in it, and one
/// line on each side. A line is held back until the motor track reaches beyond its last beam, so
/// whoever gets it can place every beam of it.
class LineGate {
 public:
  /// `to_rad` below `from_rad` is a sweep downwards.
  LineGate(const LidarModel& lidar, double from_rad, double to_rad);

  void Push(LidarLine line) { waiting_.push_back(std::move(line)); }
  /// The lines that can be handed on now, in order.
  std::vector<LidarLine> Take(const MotorTrack& track);
  /// Forgets waiting lines with a stamp after `time_s`.
  void DropAfter(double time_s);
  /// Whether the line after the scope has been handed on. Nothing comes after it.
  bool Passed() const { return passed_; }
  /// Lines of the scope that were left out so far because the motor track has a hole where they
  /// were measured: nobody can say where they looked.
  int Unplaced() const { return unplaced_; }

 private:
  void Judge(LidarLine line, const MotorTrack& track, std::vector<LidarLine>& out);

  LidarModel lidar_;
  double sign_;
  double low_rad_;   ///< along the sweep
  double high_rad_;  ///< along the sweep
  std::deque<LidarLine> waiting_;
  std::optional<LidarLine> before_;
  bool passed_ = false;
  int unplaced_ = 0;
  int perhaps_unplaced_ = 0;  ///< since the last line that could be placed
};

}  // namespace foresight
