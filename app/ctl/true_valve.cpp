#include "app/ctl/true_valve.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace foresight {

std::optional<ImageRoi> RegionOfTrueValve(const ValveTruth& valve, const World& world,
                                          double motor_rad) {
  const SensorRig& rig = world.true_rig();
  const auto camera_from_object =
      rig.CameraFromBase(motor_rad) * (world.BaseFromRobot() * valve.robot_from_object);
  Eigen::AlignedBox2d box;
  for (const auto& line : WireframeOf(valve.model))
    for (const auto& point : line)
      if (const auto pixel = rig.camera.Project(camera_from_object * point);
          pixel && rig.camera.InImage(*pixel))
        box.extend(*pixel);
  if (box.isEmpty()) return std::nullopt;
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(0.15 * box.sizes().maxCoeff());
  const Eigen::Vector2d last(rig.camera.width - 1, rig.camera.height - 1);
  return ImageRoi::Rectangle(motor_rad, (box.min() - margin).cwiseMax(Eigen::Vector2d::Zero()),
                             (box.max() + margin).cwiseMin(last));
}

ValveError CompareWithTruth(const ValveCandidate& found, const ValveTruth& truth,
                            const World& world) {
  const Rigid<frame::Base, frame::Object> true_pose =
      world.BaseFromRobot() * truth.robot_from_object;
  const Eigen::Vector3d found_axis = found.base_from_object.Rotate(Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d true_axis = true_pose.Rotate(Eigen::Vector3d::UnitZ());
  ValveError error;
  error.center_m = (found.base_from_object.translation() - true_pose.translation()).norm();
  error.axis_rad = std::acos(std::clamp(found_axis.dot(true_axis), -1.0, 1.0));
  error.radius_m = found.model.rim_radius_m - truth.model.rim_radius_m;
  error.spokes = found.model.spokes - truth.model.spokes;
  return error;
}

}  // namespace foresight
