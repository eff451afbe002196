#include "core/registration/line_registrar.h"

#include <cmath>
#include <limits>

namespace foresight {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

}  // namespace

LineRegistrar::LineRegistrar(const SensorRig& rig)
    : rig_(rig), head_from_lidar_(rig.HeadFromLidar()) {
  directions_.reserve(static_cast<std::size_t>(rig.lidar.beams));
  for (int beam = 0; beam < rig.lidar.beams; ++beam)
    directions_.push_back(rig.lidar.BeamDirection(beam));
}

Status LineRegistrar::CheckLine(const LidarLine& line) const {
  if (static_cast<int>(line.range_mm.size()) != beams())
    return Fail(ErrorCode::kInvalidInput, "line {}: {} beams, but the rig's lidar has {}", line.seq,
                line.range_mm.size(), beams());
  if (!line.intensity.empty() && line.intensity.size() != line.range_mm.size())
    return Fail(ErrorCode::kInvalidInput, "line {}: {} intensities for {} ranges", line.seq,
                line.intensity.size(), line.range_mm.size());
  return {};
}

LineRegistrar::Rows LineRegistrar::Append(RegisteredScan& scan, int lines) {
  const std::size_t count = static_cast<std::size_t>(lines) * static_cast<std::size_t>(scan.beams);
  scan.lines += lines;
  return {scan.points.Append(count, Eigen::Vector3f::Constant(kNaN)),
          scan.range_m.Append(count, kNaN), scan.intensity.Append(count, 0.0f),
          scan.origins.Append(static_cast<std::size_t>(lines), Eigen::Vector3f::Constant(kNaN))};
}

int LineRegistrar::Place(const LidarLine& line, const MotorTrack& track, const Rows& rows,
                         std::size_t row) const {
  int returns = 0;
  const double middle_s = line.time_s + rig_.lidar.BeamTime(beams() / 2);
  const double middle_rad = track.AngleAt(middle_s);
  if (!std::isnan(middle_rad))
    rows.origins[row] =
        (rig_.BaseFromHead(middle_rad) * head_from_lidar_.translation()).cast<float>();
  for (int beam = 0; beam < beams(); ++beam) {
    const auto b = static_cast<std::size_t>(beam);
    const std::size_t i = row * directions_.size() + b;
    if (!line.intensity.empty()) rows.intensity[i] = line.intensity[b];
    const double range = line.RawRange(beam) + rig_.lidar.range_offset_m;
    if (!(range >= rig_.lidar.min_range_m && range <= rig_.lidar.max_range_m)) continue;
    const double motor_rad = track.AngleAt(line.time_s + rig_.lidar.BeamTime(beam));
    if (std::isnan(motor_rad)) continue;
    const Eigen::Vector3d in_head = head_from_lidar_ * (range * directions_[b]);
    rows.points[i] = (rig_.BaseFromHead(motor_rad) * in_head).cast<float>();
    rows.range_m[i] = static_cast<float>(range);
    ++returns;
  }
  return returns;
}

}  // namespace foresight
