#pragma once

#include "core/calibration/calibrate_chain.h"

namespace foresight {

/// How well everything that was measured of one board at one place of the stand fits.
struct BoardFit {
  int pose = 0;
  bool on_b = false;
  int corners = 0;
  double rms_px = 0.0;  ///< of the corners' distances
  int returns = 0;      ///< of the lidar, sweeps too
  double rms_m = 0.0;   ///< along the beams
  double mean_m = 0.0;  ///< signed
};

/// Of each pose and board that has a measurement, in this order.
std::vector<BoardFit> FitsOfBoards(const ChainCalibration& found);

/// A return of the lidar on a board, in the image of its stop.
struct LidarImagePoint {
  int pose = 0;
  int stop = 0;  ///< of ChainState::motor_rad
  bool on_b = false;
  /// Where the camera sees the point, and how far it lies from its board along the beam: with the
  /// lidar as it was thought to sit, and as it was found.
  Eigen::Vector2d pixel_before, pixel_after;
  double residual_before_m = 0.0, residual_after_m = 0.0;
};

/// The returns at the stops that the answer was computed from. `prior` tells the lidar's place and
/// range offset before; camera, motor and boards are those found. What the camera cannot see, or
/// what missed its board before, has NaN there.
std::vector<LidarImagePoint> LidarOnImages(const ChainCalibration& found, const SensorRig& prior);

}  // namespace foresight
