#pragma once

#include <cstdint>
#include <string_view>

#include "core/calibration/calibrate_chain.h"
#include "core/calibration/calibration_session.h"

namespace foresight {

/// How the camera is mounted on the head.
enum class CameraMount { kNormal, kPortrait, kUpsideDown };
std::string_view ToString(CameraMount mount);

/// A calibration session of a head that exists in numbers only: boards are planes, the room is a
/// box, and every error is drawn from its distribution. The defaults are those of a good session.
struct CalibrationSimulation {
  std::uint64_t seed = 1;
  CameraMount mount = CameraMount::kNormal;
  /// Boards that a detector can tell apart, and their corner 0 from the others: for images.
  bool distinct_boards = false;
  int intrinsic_views = 20;
  int poses = 6;
  double first_stop_deg = -30.0;
  double last_stop_deg = 80.0;
  double stop_step_deg = 10.0;
  int scans_per_stop = 40;
  int sweeps = 6;  ///< of the poses, before how many the head sweeps up and down too
  bool one_way_sweep = false;
  double sweep_speed_deg_s = 50.0;

  double corner_sigma_px = 0.287;  ///< an axis
  double range_sigma_m = 0.020;
  double range_bias_m = 0.0;           ///< ranges read longer by this
  double stamp_offset_s = 0.008;       ///< a line's beam 0 fires this much after its stamp
  double spike_ratio = 0.01;           ///< returns at a random range
  double mixed_pixel_ratio = 0.5;      ///< of the returns at an edge: between the two surfaces
  double repeatability_rad = 1.75e-4;  ///< of a stop, 0.01 deg
  double angle_error_rad = 2.5e-3;     ///< plate against encoder, amplitude of its slow waves
  double dihedral_error_rad = 0.005;   ///< of the stand against its drawing, an axis
  double least_distance_m = 0.8;
  double most_distance_m = 1.5;
  double rig_error_rad = 0.02;  ///< the true head against DefaultSensorRig()
  double rig_error_m = 0.010;
  double prior_error_rad = 0.0872664626;  ///< the CAD poses against the true ones: 5 deg
  double prior_error_m = 0.100;

  /// Names the member at fault.
  Status Check() const;
};

struct SimulatedCalibration {
  CalibrationSession session;
  SensorRig truth;  ///< plate angles between the knots are a spline's, as in the session
  BoardFromBoard a_from_b;
  std::vector<Rigid<frame::Base, frame::Pattern>> base_from_pattern;
  std::vector<Rigid<frame::Camera, frame::Pattern>> camera_from_view;  ///< intrinsic views
  /// Of each pose and stop of the session, with the stop's own angle.
  std::vector<std::vector<Rigid<frame::Camera, frame::Pattern>>> camera_from_stand;
};

/// The same options give the same session on every machine. Fails with kInvalidOptions. Half a
/// second.
Result<SimulatedCalibration> SimulateCalibration(const CalibrationSimulation& options);

/// How far each unknown of the covariance is from the truth, in its order and units: what the
/// covariance is a covariance of. @pre found.covariance
Eigen::VectorXd DeviationsFromTruth(const ChainCalibration& found,
                                    const SimulatedCalibration& truth);

}  // namespace foresight
