#include "core/calibration/compare_rigs.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/calibration/tangent.h"

namespace foresight {
namespace {

constexpr int kGrid = 24;  ///< rays an edge of the image

Eigen::Vector3d AxisOf(const SensorRig& rig) {
  return rig.camera_from_head.Rotate(Eigen::Vector3d::UnitX());
}

/// The point of the motor's axis next to the camera.
Eigen::Vector3d NearestOf(const SensorRig& rig) {
  const Eigen::Vector3d t = rig.camera_from_head.translation();
  return t - AxisOf(rig) * AxisOf(rig).dot(t);
}

void CompareCameras(const CameraModel& camera, const CameraModel& other, RigError* error) {
  double sum_px2 = 0.0;
  int count = 0;
  for (int row = 0; row < kGrid; ++row)
    for (int column = 0; column < kGrid; ++column) {
      const Eigen::Vector2d pixel((column + 0.5) / kGrid * camera.width - 0.5,
                                  (row + 0.5) / kGrid * camera.height - 0.5);
      const auto ray = camera.Unproject(pixel);
      const auto seen = ray ? other.Project(*ray) : std::nullopt;
      if (!seen) continue;
      const double distance_px = (*seen - pixel).norm();
      sum_px2 += distance_px * distance_px;
      error->camera_most_px = std::max(error->camera_most_px, distance_px);
      ++count;
    }
  error->camera_rms_px = count > 0 ? std::sqrt(sum_px2 / count) : std::nan("");
  if (count == 0) error->camera_most_px = std::nan("");
}

void CompareAngles(const AngleCorrection& angles, const AngleCorrection& other, RigError* error) {
  std::set<double> knots;
  for (const AngleCorrection* correction : {&angles, &other})
    for (const auto& knot : correction->knots()) knots.insert(knot.motor_rad);
  knots.erase(0.0);  // equal by definition
  for (const double knot : knots) {
    const double e = std::abs((angles.PlateAngle(knot) - angles.PlateAngle(0.0)) -
                              (other.PlateAngle(knot) - other.PlateAngle(0.0)));
    error->angles_rms_rad += e * e;
    error->angles_most_rad = std::max(error->angles_most_rad, e);
  }
  if (!knots.empty())
    error->angles_rms_rad = std::sqrt(error->angles_rms_rad / static_cast<double>(knots.size()));
}

}  // namespace

Result<RigError> CompareRigs(const SensorRig& rig, const SensorRig& other) {
  if (rig.camera.width != other.camera.width || rig.camera.height != other.camera.height)
    return Fail(ErrorCode::kInvalidInput,
                "the rigs are of different heads: images of {} x {} px and of {} x {} px",
                rig.camera.width, rig.camera.height, other.camera.width, other.camera.height);
  if (rig.lidar.beams != other.lidar.beams)
    return Fail(ErrorCode::kInvalidInput, "the rigs are of different heads: {} beams and {} beams",
                rig.lidar.beams, other.lidar.beams);
  RigError error;
  error.focal_px = std::max(std::abs(rig.camera.fx - other.camera.fx),
                            std::abs(rig.camera.fy - other.camera.fy));
  CompareCameras(rig.camera, other.camera, &error);
  error.axis_rad =
      std::atan2(AxisOf(rig).cross(AxisOf(other)).norm(), AxisOf(rig).dot(AxisOf(other)));
  error.axis_m = (NearestOf(rig) - NearestOf(other)).norm();
  CompareAngles(rig.angle_correction, other.angle_correction, &error);
  const auto step = StepBetween(other.camera_from_lidar, rig.camera_from_lidar);
  error.lidar_rad = step.head<3>().norm();
  error.lidar_m = step.tail<3>().norm();
  error.range_offset_m = rig.lidar.range_offset_m - other.lidar.range_offset_m;
  error.stamp_offset_s = rig.lidar.stamp_offset_s - other.lidar.stamp_offset_s;
  return error;
}

}  // namespace foresight
