#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/depth/upsample.h"
#include "core/measure/measured_point.h"
#include "core/registration/register_scan.h"
#include "core/sensor/camera_frame.h"
#include "core/sensor/sensor_rig.h"

namespace foresight {

/// A click on a cloud as it is looked at.
struct CloudClick {
  /// Homogeneous: x and y over w are in [-1, 1] where a point is seen, y up; w is the distance
  /// along the line of sight, metres.
  Eigen::Matrix4d clip_from_robot = Eigen::Matrix4d::Identity();
  Eigen::Vector2d at = Eigen::Vector2d::Zero();  ///< in the same [-1, 1]
  /// How far a point may be from it, along both axes.
  Eigen::Vector2d reach = Eigen::Vector2d::Constant(0.02);
  /// Points in robot that are drawn; empty = all.
  std::function<bool(const Eigen::Vector3d&)> shown = nullptr;
};

/// The return nearest to the click among those that nothing in front of them within reach hides;
/// nullopt where none is within reach. Its sigma is that of the ranges around it, where enough
/// neighbours tell. O(points).
std::optional<MeasuredPoint> PickReturn(const RegisteredScan& cloud, const SensorRig& rig,
                                        const std::string& scan_uuid, const CloudClick& click);

/// The pixel's depth as a point; nullopt where it has none or `mask` hides it. `image` is its
/// position in the scan. The sigma of a depth map is not known.
std::optional<MeasuredPoint> PickDepth(const DepthImage& depth_m, const MaskImage* mask,
                                       const CameraFrame& frame, const SensorRig& rig,
                                       const std::string& scan_uuid, int image, int u, int v);

/// The returns around a place, all in robot.
std::vector<Eigen::Vector3d> ReturnsWithin(const RegisteredScan& cloud, const SensorRig& rig,
                                           const Eigen::Vector3d& centre, double radius_m);

}  // namespace foresight
