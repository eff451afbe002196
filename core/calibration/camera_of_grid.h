#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "core/geometry/rigid.h"
#include "core/sensor/camera_model.h"

namespace foresight {

/// The camera that an organised cloud was made with.
struct GridCamera {
  CameraModel camera;                                    ///< a pinhole with a pixel for each point
  Rigid<frame::Camera, frame::Robot> camera_from_cloud;  ///< the cloud's frame in place of robot
  double rms_px = 0.0;  ///< how far points appear from their own pixel
};

/// A depth camera writes a point a pixel, row by row: then the pixels of its points say what camera
/// it is, and how the cloud's frame lies, as long as the frame's origin is the camera. nullopt
/// where the rows are no image of a pinhole camera (a lidar's, a cloud with its origin elsewhere).
/// O(n).
/// @pre points.size() is a multiple of width
std::optional<GridCamera> CameraOfGrid(std::span<const Eigen::Vector3d> points, int width);

}  // namespace foresight
