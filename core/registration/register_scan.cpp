#include "core/registration/register_scan.h"

#include <atomic>
#include <cmath>
#include <limits>

#include "core/base/parallel.h"

namespace foresight {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// Places one line; returns the number of returns.
int RegisterLine(const Scan& scan, const Rigid<frame::Head, frame::Lidar>& head_from_lidar,
                 const std::vector<Eigen::Vector3d>& directions, int row, RegisteredScan& out) {
  const SensorRig& rig = scan.rig;
  const LidarLine& line = scan.lines[static_cast<std::size_t>(row)];
  int returns = 0;
  const double middle_s = line.time_s + rig.lidar.BeamTime(out.beams / 2);
  const double middle_rad = scan.track.AngleAt(middle_s);
  if (!std::isnan(middle_rad))
    out.origins[static_cast<std::size_t>(row)] =
        (rig.BaseFromHead(middle_rad) * head_from_lidar.translation()).cast<float>();
  for (int beam = 0; beam < out.beams; ++beam) {
    const std::size_t i = out.Index(row, beam);
    if (!line.intensity.empty()) out.intensity[i] = line.intensity[static_cast<std::size_t>(beam)];
    const double range = line.RawRange(beam) + rig.lidar.range_offset_m;
    if (!(range >= rig.lidar.min_range_m && range <= rig.lidar.max_range_m)) continue;
    const double motor_rad = scan.track.AngleAt(line.time_s + rig.lidar.BeamTime(beam));
    if (std::isnan(motor_rad)) continue;
    const Eigen::Vector3d in_head =
        head_from_lidar * (range * directions[static_cast<std::size_t>(beam)]);
    out.points[i] = (rig.BaseFromHead(motor_rad) * in_head).cast<float>();
    out.range_m[i] = static_cast<float>(range);
    ++returns;
  }
  return returns;
}

}  // namespace

Result<RegisteredScan> RegisterScan(const Scan& scan, const RunContext& context) {
  FORESIGHT_CHECK(scan.rig.Check());
  RegisteredScan out;
  out.lines = static_cast<int>(scan.lines.size());
  out.beams = scan.rig.lidar.beams;
  for (const LidarLine& line : scan.lines) {
    if (static_cast<int>(line.range_mm.size()) != out.beams)
      return Fail(ErrorCode::kInvalidInput, "line {}: {} beams, but the rig's lidar has {}",
                  line.seq, line.range_mm.size(), out.beams);
    if (!line.intensity.empty() && line.intensity.size() != line.range_mm.size())
      return Fail(ErrorCode::kInvalidInput, "line {}: {} intensities for {} ranges", line.seq,
                  line.intensity.size(), line.range_mm.size());
  }
  const std::size_t count =
      static_cast<std::size_t>(out.lines) * static_cast<std::size_t>(out.beams);
  out.points.assign(count, Eigen::Vector3f::Constant(kNaN));
  out.range_m.assign(count, kNaN);
  out.intensity.assign(count, 0.0f);
  out.origins.assign(scan.lines.size(), Eigen::Vector3f::Constant(kNaN));

  std::vector<Eigen::Vector3d> directions;
  for (int beam = 0; beam < out.beams; ++beam)
    directions.push_back(scan.rig.lidar.BeamDirection(beam));
  const Rigid<frame::Head, frame::Lidar> head_from_lidar = scan.rig.HeadFromLidar();
  std::atomic<std::int64_t> returns{0};
  std::atomic<int> done{0};
  const bool finished = ParallelFor(out.lines, context, [&](int row) {
    returns += RegisterLine(scan, head_from_lidar, directions, row, out);
    context.Report(static_cast<double>(++done) / out.lines, "placing lidar lines");
  });
  if (!finished) return Fail(ErrorCode::kCancelled, "registration was cancelled");
  if (returns == 0)
    return Fail(ErrorCode::kTooFewPoints,
                "no return in {} lidar lines has a range and a motor angle", out.lines);
  return out;
}

}  // namespace foresight
