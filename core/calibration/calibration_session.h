#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/objects/board_mount.h"
#include "core/sensor/lidar_line.h"
#include "core/sensor/motor_track.h"
#include "core/sensor/sensor_rig.h"

namespace foresight {

/// What the camera saw of a stand in one image; a board that was not found is missing.
struct MountView {
  std::string source;  ///< the image, for messages
  std::optional<BoardView> a;
  std::optional<BoardView> b;
  /// Why a board is missing, where the image says it: "overexposed: ...".
  std::string fault = {};

  bool empty() const { return !a && !b; }
};

/// One angle at which the motor stood still before a stand that stood still.
struct MotorStop {
  double motor_rad = 0.0;        ///< commanded
  MountView view;                ///< empty = no image, or no board in it
  std::vector<LidarLine> lines;  ///< all of one angle; their time does not matter
};

/// The lidar's lines while the motor moved.
struct MountSweep {
  std::vector<LidarLine> lines;
  MotorTrack track;
};

/// One place of the stand.
struct PatternPose {
  std::string name;
  std::vector<MotorStop> stops;
  MountSweep sweep;  ///< empty = none
};

/// One image of a single board for the camera alone.
struct IntrinsicView {
  std::string source;
  BoardView view;
};

/// Everything that a calibration of a head is computed from.
struct CalibrationSession {
  std::string name = "unnamed";
  BoardMount mount;
  CalibrationBoard intrinsic_board;
  std::vector<IntrinsicView> intrinsic_views;
  std::vector<PatternPose> poses;
  /// What was known before: image size and start of the camera, the lidar, the CAD poses of camera
  /// and lidar (5 deg and 100 mm off are no harm), and the table of angles in use.
  SensorRig prior;
  /// Images that could not be used and why, a sentence each: "view 3.png: blurred: ...".
  std::vector<std::string> unusable_images = {};

  /// Fails with kInvalidInput, naming pose, stop and what is wrong there.
  Status Check() const;
};

/// Angles less than this apart are one stop.
inline constexpr double kSameStop_rad = 2e-4;

/// The commanded angles of all stops that have an image or lines, increasing.
std::vector<double> StopAngles(const CalibrationSession& session);
/// The place of `motor_rad` in `angles`. @pre it is there
int StopIndex(const std::vector<double>& angles, double motor_rad);

}  // namespace foresight
