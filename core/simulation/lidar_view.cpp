#include "core/simulation/lidar_view.h"

#include <cmath>
#include <numbers>

#include "core/base/contract.h"

namespace foresight {
namespace {

bool InFan(const LidarModel& lidar, const Eigen::Vector3d& in_lidar) {
  const double range = in_lidar.norm();
  const double angle = std::atan2(in_lidar.y(), in_lidar.x());
  return range >= lidar.min_range_m && range <= lidar.max_range_m && angle >= lidar.BeamAngle(0) &&
         angle <= lidar.BeamAngle(lidar.beams - 1);
}

}  // namespace

LidarView::LidarView(const RayCaster& caster, const SensorRig& true_rig, double low_plate_rad,
                     double high_plate_rad)
    : caster_(caster),
      lidar_(true_rig.lidar),
      head_from_lidar_(true_rig.HeadFromLidar()),
      robot_from_base_(true_rig.robot_from_base),
      low_plate_rad_(low_plate_rad),
      high_plate_rad_(high_plate_rad) {
  FORESIGHT_EXPECTS(low_plate_rad <= high_plate_rad, "a sweep goes from low to high");
}

std::vector<double> LidarView::PlateAnglesThrough(const Eigen::Vector3d& in_base) const {
  // n . (Rot_x(-angle) p - o) = 0 with the fan's normal n and origin o in head, written as
  // a cos(angle) + b sin(angle) = c.
  const Eigen::Vector3d normal = head_from_lidar_.Rotate(Eigen::Vector3d::UnitZ());
  const double a = normal.y() * in_base.y() + normal.z() * in_base.z();
  const double b = normal.y() * in_base.z() - normal.z() * in_base.y();
  const double c = normal.dot(head_from_lidar_.translation()) - normal.x() * in_base.x();
  const double reach = std::hypot(a, b);
  if (!(std::abs(c) <= reach)) return {};
  std::vector<double> angles;
  for (const double side : {-1.0, 1.0}) {
    const double angle =
        std::remainder(std::atan2(b, a) + side * std::acos(c / reach), 2.0 * std::numbers::pi);
    if (angle >= low_plate_rad_ && angle <= high_plate_rad_) angles.push_back(angle);
  }
  return angles;
}

void LidarView::Seen(std::span<const Eigen::Vector3d> in_robot,
                     std::span<std::uint8_t> seen) const {
  FORESIGHT_EXPECTS(in_robot.size() == seen.size(), "an answer for every point");
  std::vector<SceneRay> rays;
  std::vector<float> lengths_m;
  std::vector<std::size_t> owner;
  for (std::size_t i = 0; i < in_robot.size(); ++i) {
    seen[i] = 0;
    if (!in_robot[i].allFinite()) continue;
    for (const double plate_rad : PlateAnglesThrough(robot_from_base_.Inverse() * in_robot[i])) {
      const Rigid<frame::Robot, frame::Lidar> robot_from_lidar =
          robot_from_base_ * HeadFromBase(plate_rad).Inverse() * head_from_lidar_;
      if (!InFan(lidar_, robot_from_lidar.Inverse() * in_robot[i])) continue;
      const Eigen::Vector3d to_point = in_robot[i] - robot_from_lidar.translation();
      rays.push_back(
          {robot_from_lidar.translation().cast<float>(), to_point.normalized().cast<float>()});
      lengths_m.push_back(static_cast<float>(to_point.norm() - kTolerance_m));
      owner.push_back(i);
    }
  }
  std::vector<std::uint8_t> occluded(rays.size());
  caster_.Occluded(rays, lengths_m, occluded);
  for (std::size_t k = 0; k < rays.size(); ++k)
    if (occluded[k] == 0) seen[owner[k]] = 1;
}

}  // namespace foresight
