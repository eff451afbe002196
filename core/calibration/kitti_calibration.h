#pragma once

#include <string>
#include <string_view>

#include "core/geometry/rigid.h"
#include "core/sensor/camera_model.h"

namespace foresight {

/// A camera of the KITTI data sets, rectified: a pinhole without distortion.
struct KittiCamera {
  CameraModel camera;  ///< without the image's size, which the file does not say
  /// From the Velodyne's frame (x forward, y left, z up), here in place of robot.
  Rigid<frame::Camera, frame::Robot> camera_from_velodyne;
};

/// Whether a text looks like one of KITTI's calibration files.
bool LooksLikeKittiCalibration(std::string_view text);

/// Camera `number` (0 to 3; 2 is the left colour camera) of a calibration file of KITTI's object,
/// tracking or odometry sets: its rows P0 to P3, R0_rect (or R_rect; missing = no turn) and
/// Tr_velo_to_cam (or Tr_velo_cam, Tr). Fails with kBadData, naming `source` and the row.
Result<KittiCamera> KittiCameraFrom(std::string_view text, int number, const std::string& source);

}  // namespace foresight
