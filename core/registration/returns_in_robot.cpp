#include "core/registration/returns_in_robot.h"

namespace foresight {

std::vector<Eigen::Vector3f> ReturnsInRobot(const RegisteredScan& cloud, const SensorRig& rig) {
  std::vector<Eigen::Vector3f> points;
  for (int line = 0; line < cloud.lines; ++line)
    for (int beam = 0; beam < cloud.beams; ++beam)
      if (cloud.Valid(line, beam))
        points.push_back(
            (rig.robot_from_base * cloud.points[cloud.Index(line, beam)].cast<double>())
                .cast<float>());
  return points;
}

}  // namespace foresight
