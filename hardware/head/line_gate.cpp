#include "hardware/head/line_gate.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace foresight {

LineGate::LineGate(const LidarModel& lidar, double from_rad, double to_rad)
    : lidar_(lidar),
      sign_(to_rad > from_rad ? 1.0 : -1.0),
      low_rad_(sign_ * from_rad),
      high_rad_(sign_ * to_rad) {}

std::vector<LidarLine> LineGate::Take(const MotorTrack& track) {
  std::vector<LidarLine> out;
  const double known_until_s = track.empty() ? -INFINITY : track.samples().back().time_s;
  while (!waiting_.empty()) {
    const double end_s = waiting_.front().time_s + lidar_.BeamTime(lidar_.beams - 1);
    // The whole window of the fit: the angle must not change when later samples arrive.
    if (end_s + MotorTrack::kWindow_s > known_until_s) break;
    Judge(std::move(waiting_.front()), track, out);
    waiting_.pop_front();
  }
  return out;
}

void LineGate::DropAfter(double time_s) {
  std::erase_if(waiting_, [time_s](const LidarLine& line) { return line.time_s > time_s; });
}

void LineGate::Judge(LidarLine line, const MotorTrack& track, std::vector<LidarLine>& out) {
  if (passed_) return;
  const double first = sign_ * track.AngleAt(line.time_s + lidar_.BeamTime(0));
  const double last = sign_ * track.AngleAt(line.time_s + lidar_.BeamTime(lidar_.beams - 1));
  if (std::isnan(first) || std::isnan(last)) {
    ++perhaps_unplaced_;
    return;
  }
  const int unplaced = std::exchange(perhaps_unplaced_, 0);
  const auto [lowest, highest] = std::minmax(first, last);
  if (highest <= high_rad_ && lowest < low_rad_) {
    before_ = std::move(line);
    return;
  }
  if (before_) out.push_back(*std::exchange(before_, std::nullopt));
  unplaced_ += unplaced;
  passed_ = highest > high_rad_;
  out.push_back(std::move(line));
}

}  // namespace foresight
