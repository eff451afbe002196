#pragma once

#include <filesystem>
#include <string>

#include "core/geometry/rigid.h"
#include "core/sensor/camera_model.h"
#include "core/sensor/lidar_line.h"
#include "core/sensor/motor_track.h"
#include "core/sensor/robot_frame_source.h"

namespace foresight {

/// Everything a calibration knows of one head. Immutable once recorded with a scan.
/// rig_id.h has its id.
struct SensorRig {
  std::string name = "unnamed";
  std::string date_utc;   ///< when it was calibrated, "2026-03-01T09:30:00Z"; empty = not known
  std::string parent_id;  ///< RigId of the rig it was made from; empty = none
  CameraModel camera;
  LidarModel lidar;
  AngleCorrection angle_correction;
  Rigid<frame::Camera, frame::Head> camera_from_head;    ///< H_mc of Eq. (5)
  Rigid<frame::Camera, frame::Lidar> camera_from_lidar;  ///< H_lc of Eq. (6)
  Rigid<frame::Robot, frame::Base> robot_from_base;      ///< how the head is mounted
  RobotFrameSource robot_frame_source = RobotFrameSource::kUnknown;

  Status Check() const;

  Rigid<frame::Head, frame::Lidar> HeadFromLidar() const {
    return camera_from_head.Inverse() * camera_from_lidar;
  }
  /// Where the plate is when the motor reports `motor_rad`.
  Rigid<frame::Base, frame::Head> BaseFromHead(double motor_rad) const {
    return HeadFromBase(angle_correction.PlateAngle(motor_rad)).Inverse();
  }
  Rigid<frame::Camera, frame::Base> CameraFromBase(double motor_rad) const {
    return camera_from_head * BaseFromHead(motor_rad).Inverse();
  }
};

/// The head of the paper as drawn: 1288 x 964, f = 601 px, k = 0.9413, camera 60 mm above and 40 mm
/// in front of the lidar, the motor's axis between them.
SensorRig DefaultSensorRig();

/// The rig as YAML with its id, docs/formats.md. All values survive the round trip bit for bit.
std::string SensorRigToYaml(const SensorRig& rig);

/// Fails with kBadData, naming `source` and the line at fault; also where the file states an id
/// that is not that of its values.
Result<SensorRig> SensorRigFromYaml(const std::string& yaml, const std::string& source);
Result<SensorRig> LoadSensorRig(const std::filesystem::path& path);
Status SaveSensorRig(const SensorRig& rig, const std::filesystem::path& path);

}  // namespace foresight
