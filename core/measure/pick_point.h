#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
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

/// Chooses the point that a click means among those that are offered one after the other: the
/// nearest to the click of those that nothing in front of them within reach hides.
class ClickChoice {
 public:
  explicit ClickChoice(const CloudClick& click) : click_(click) {}
  /// `point` in the frame that the click looks at. A point out of reach, or not shown, is passed
  /// over.
  void Offer(std::size_t index, const Eigen::Vector3d& point);
  /// The index of the chosen one; nullopt where none is within reach.
  std::optional<std::size_t> Best() const;

 private:
  struct Candidate {
    std::size_t index = 0;
    double distance_m = 0.0;  ///< along the line of sight
    double beside = 0.0;      ///< squared, in units of the reach
  };
  const CloudClick& click_;
  std::vector<Candidate> candidates_;
  double nearest_m_ = std::numeric_limits<double>::infinity();
};

/// The return at a place of the grid as a point in robot. Its sigma is that of the ranges around
/// it, where enough neighbours tell. @pre the return is there. O(points).
MeasuredPoint ReturnAt(const RegisteredScan& cloud, const SensorRig& rig,
                       const std::string& scan_uuid, std::size_t index);

/// The return nearest to the click among those that nothing in front of them within reach hides;
/// nullopt where none is within reach. O(points).
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
