#pragma once

#include <optional>
#include <string>

#include "core/selfcheck/flat_cells.h"

namespace foresight {

struct PlateCheckOptions {
  FlatCellOptions cells;
  CoplanarOptions planes;
  double floor_m = 0.001;        ///< what a cell's mean is not better than: surfaces are not ideal
  double shift_prior_m = 0.005;  ///< of the lidar against the plate
  double range_prior_m = 0.010;  ///< of its ranges
  double color_prior_m = 0.015;  ///< of the ranges of one plane: lidars read black and white unlike
  /// Of the beam's half length on a surface, as ranges of it read: 0 = the middle, 1 = the near
  /// end.
  double near_end_prior = 0.5;
  Eigen::Vector2d beam_rad{0.005, 0.012};  ///< along the line and across
  double huber_sigmas = 2.0;
  double tukey_sigmas = 4.7;
  int least_planes = 2;
};

/// What the planes of one scan say of the way from the motor to the lidar: how the rig must be
/// changed to make them flat, and both directions of the motor agree.
struct PlateCheck {
  enum Unknown { kTurnY, kTurnZ, kShiftY, kShiftZ, kRange, kNearEnd, kStamp, kUnknowns };

  /// Of the lidar on the plate, about and along the head's axes, the turn about the lidar's own
  /// origin (rad, m); of its ranges (m); how near to the near end of a beam's spot they are read
  /// (of the spot's half length); of its stamps (s). Turn and shift about and along x, the motor's
  /// axis, are not among them: they move all planes alike.
  Eigen::Matrix<double, kUnknowns, 1> drift;
  Eigen::Matrix<double, kUnknowns, kUnknowns> covariance;
  bool up_and_down = false;  ///< else the stamps stay what they are, with an infinite sigma
  double speed_rad_s = 0.0;  ///< of the plate, rms; kept for the record
  int planes = 0;
  int cells = 0;
  double residual_m = 0.0;  ///< rms of the cells about their planes, after the change

  double Sigma(Unknown unknown) const { return std::sqrt(covariance(unknown, unknown)); }
};

/// Fails with kTooFewPoints where the scan shows too few planes.
Result<PlateCheck> CheckPlate(const Scan& scan, const RegisteredScan& cloud,
                              const PlateCheckOptions& options);

}  // namespace foresight
