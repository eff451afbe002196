#pragma once

#include <optional>

#include "core/calibration/calibrate_lidar.h"
#include "core/calibration/calibrate_motor.h"
#include "core/calibration/lens_model.h"

namespace foresight {

/// How far the chain is computed.
enum class CalibrationStage { kMotor, kLidar, kTime, kAll };

struct ChainCalibrationOptions {
  CalibrationStage stage = CalibrationStage::kAll;
  /// Section III-B as printed, one step after the other: Eq. (5) with the stand as drawn, Eq. (6)
  /// with distances from planes, neither offsets nor joint refinement, and no covariance.
  bool as_in_the_paper = false;
  MotorCalibrationOptions::LooseStops loose_stops = MotorCalibrationOptions::LooseStops::kRefuse;
  /// What the camera may be where the session has images for it; the best by cross-validation is
  /// taken. Empty = the lens of the session's prior.
  std::vector<LensModel> lenses;
  ChainNoise noise;
  double range_sigma_m = 0.0;    ///< of one range; 0 = from the scatter over the lines of a stop
  double range_floor_m = 0.001;  ///< least sigma of a beam's mean
  double gate_sigmas = 4.0;      ///< lidar returns farther off are left out of the joint solve
  /// Deviations of corners and ranges are estimated from the residuals: the answer's reduced
  /// chi-square is 1 then, and its covariance that of the data as they are.
  bool noise_from_residuals = false;

  Status Check() const;
};

/// How well the returns of one line fit their board.
struct LineFit {
  std::string source;
  int returns = 0;
  double rms_m = 0.0;   ///< along the beams
  double mean_m = 0.0;  ///< signed
};

/// Sums over the residuals of one kind.
struct ResidualSummary {
  int count = 0;
  double rms = 0.0;         ///< in px an axis, or m
  double chi_square = 0.0;  ///< reduced by the unknowns in proportion
};

struct ChainCalibration {
  SensorRig rig;  ///< the session's prior with everything that was found; new date and parent unset
  ChainState state;
  ChainData data;
  std::optional<ChainFit> fit;                ///< of the joint solve
  std::optional<ChainCovariance> covariance;  ///< of the joint solve; none for a single stage
  ResidualSummary corners, ranges;
  double mean_error_px = 0.0;
  std::vector<ImageFit> images;
  std::vector<LineFit> lines;
  std::optional<LidarCalibration::CrossCheck> linear;
  std::optional<double> up_ratio;  ///< of the sweeps
  double range_sigma_m = 0.0;      ///< of one range, given or estimated
  ChainNoise noise;                ///< as used
  /// The direction that is known worst for what it is needed for, and what to record, in words.
  std::string weakest;
  std::vector<std::string> notes;
  struct Seconds {
    double camera = 0.0, motor = 0.0, lidar = 0.0, time = 0.0, joint = 0.0;
  };
  Seconds seconds;
};

/// The chain camera -> motor -> lidar -> time, one stage after the other, then all in one least
/// squares problem. The camera needs no guess where the session has images of a board for it; else
/// it is the prior's. A stage that the session has no data for fails; the joint solve goes
/// without a sweep, and keeps the prior's stamp offset then.
Result<ChainCalibration> CalibrateChain(const CalibrationSession& session,
                                        const ChainCalibrationOptions& options,
                                        const RunContext& context);

}  // namespace foresight
