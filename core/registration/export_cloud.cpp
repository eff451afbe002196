#include "core/registration/export_cloud.h"

namespace foresight {

std::vector<CloudPoint> PointsInRobot(const RegisteredScan& cloud, const SensorRig& rig) {
  std::vector<CloudPoint> points;
  for (int line = 0; line < cloud.lines; ++line) {
    for (int beam = 0; beam < cloud.beams; ++beam) {
      if (!cloud.Valid(line, beam)) continue;
      const std::size_t index = cloud.Index(line, beam);
      const Eigen::Vector3f point =
          (rig.robot_from_base * cloud.points[index].cast<double>()).cast<float>();
      points.push_back(
          {point.x(), point.y(), point.z(), cloud.intensity[index], line, beam, Rgb8()});
    }
  }
  return points;
}

Result<std::size_t> ExportCloud(const RegisteredScan& cloud, const SensorRig& rig,
                                const std::string& scan_uuid, std::int64_t scan_utc_ns,
                                const std::filesystem::path& path) {
  const std::vector<CloudPoint> points = PointsInRobot(cloud, rig);
  const CloudOrigin origin{"robot", scan_uuid, scan_utc_ns};
  const auto write = path.extension() == ".pcd" ? WritePcd : WritePly;
  FORESIGHT_CHECK(write(path, points, CloudColors::kNone, origin));
  return points.size();
}

}  // namespace foresight
