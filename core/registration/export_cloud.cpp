#include "core/registration/export_cloud.h"

#include <limits>

namespace foresight {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

}  // namespace

std::vector<CloudPoint> PointsInRobot(const RegisteredScan& cloud, const Scan& scan) {
  std::vector<CloudPoint> points;
  for (int line = 0; line < cloud.lines; ++line) {
    const auto row = static_cast<std::size_t>(line);
    const double line_s = row < scan.lines.size() ? scan.lines[row].time_s : kNoValue;
    for (int beam = 0; beam < cloud.beams; ++beam) {
      if (!cloud.Valid(line, beam)) continue;
      const std::size_t index = cloud.Index(line, beam);
      const Eigen::Vector3f place =
          (scan.rig.robot_from_base * cloud.points[index].cast<double>()).cast<float>();
      CloudPoint point;
      point.x = place.x();
      point.y = place.y();
      point.z = place.z();
      point.intensity = cloud.intensity[index];
      point.line = line;
      point.beam = beam;
      point.time_s = scan.given.time_s.empty() ? line_s + scan.rig.lidar.BeamTime(beam)
                                               : scan.given.time_s[index];
      points.push_back(point);
    }
  }
  return points;
}

Result<std::size_t> ExportCloud(const RegisteredScan& cloud, const Scan& scan,
                                const std::filesystem::path& path) {
  const std::vector<CloudPoint> points = PointsInRobot(cloud, scan);
  const CloudOrigin origin{"robot", scan.uuid, scan.start_utc_ns};
  const auto write = path.extension() == ".pcd" ? WritePcd : WritePly;
  FORESIGHT_CHECK(write(path, points, CloudFields::kMeasured, origin));
  return points.size();
}

}  // namespace foresight
