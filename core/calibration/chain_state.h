#pragma once

#include <limits>
#include <vector>

#include "core/calibration/calibration_session.h"

namespace foresight {

/// Everything that the chain camera -> motor -> lidar -> time estimates, at its present values.
struct ChainState {
  CameraModel camera;
  Rigid<frame::Camera, frame::Head> camera_from_head;    ///< H_mc, Eq. (5)
  Rigid<frame::Camera, frame::Lidar> camera_from_lidar;  ///< H_lc, Eq. (6)
  BoardFromBoard a_from_b;                               ///< of the stand
  std::vector<double> motor_rad;                         ///< commanded angle of each stop
  std::vector<double> plate_rad;                         ///< A_theta of each stop
  int reference_stop = 0;                                ///< whose A_theta is 0, fixed
  std::vector<Rigid<frame::Base, frame::Pattern>> base_from_pattern;   ///< H_n, a pose of the stand
  std::vector<Rigid<frame::Camera, frame::Pattern>> camera_from_view;  ///< intrinsic images
  std::vector<double> jitter_rad;  ///< of each visit: plate's angle minus A_theta of its stop
  double range_offset_m = 0.0;     ///< added to every range
  double stamp_offset_s = 0.0;     ///< added to every line's stamp

  Rigid<frame::Camera, frame::Base> CameraFromBase(int stop, double jitter) const {
    return camera_from_head * HeadFromBase(plate_rad[static_cast<std::size_t>(stop)] + jitter);
  }
};

/// The corners of one board in one image.
struct CornerSet {
  static constexpr int kNone = -1;

  int view = kNone;   ///< intrinsic image, or
  int pose = kNone;   ///< pose of the stand,
  int visit = kNone;  ///< visit of a stop in this pose,
  int stop = kNone;   ///< and the stop
  bool on_b = false;  ///< board B of the stand
  std::string source;
  std::vector<Eigen::Vector3d> on_board;
  std::vector<Eigen::Vector2d> pixels;
};

/// One range along a ray of the lidar.
struct LidarReturn {
  Eigen::Vector3d direction;  ///< unit, in lidar
  double range_m = 0.0;       ///< without offset
  double sigma_m = 0.0;
  double time_s = 0.0;  ///< on the motor track's clock, without stamp offset; sweeps only
  int beam = 0;
};

/// Returns of one line, or of the mean of several, from one board.
struct BoardHits {
  static constexpr int kNone = -1;

  int pose = kNone;
  int visit = kNone;  ///< of a stop; kNone in a sweep
  int stop = kNone;
  bool on_b = false;
  std::vector<LidarReturn> returns;
};

struct ChainData {
  std::vector<CornerSet> corners;
  std::vector<BoardHits> hits;
  std::vector<MotorTrack> tracks;  ///< a pose; empty = no sweep
  double period_s = 0.025;
};

}  // namespace foresight
