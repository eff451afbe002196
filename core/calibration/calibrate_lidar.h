#pragma once

#include <optional>

#include "core/base/run_context.h"
#include "core/calibration/chain_problem.h"
#include "core/calibration/lidar_profiles.h"

namespace foresight {

struct LidarCalibrationOptions {
  ChainNoise noise;
  LidarResidual residual = LidarResidual::kRange;
  bool range_offset = true;  ///< estimate it, with its prior
  /// Wide to narrow: the prior may be 5 deg and 100 mm off.
  std::vector<AssociationOptions> rounds = {{.margin_m = 0.060, .depth_m = 0.250},
                                            {.margin_m = 0.040, .depth_m = 0.120},
                                            {.margin_m = 0.020, .depth_m = 0.080},
                                            {.margin_m = 0.020, .depth_m = 0.060}};
  double huber_sigmas = 3.0;
  double gate_sigmas = 4.0;  ///< returns farther off are left out of the last solve; 0 = all stay

  Status Check() const;
};

/// Camera and lidar.
struct LidarCalibration {
  ChainState state;
  std::vector<BoardHits> hits;
  ChainFit fit;
  double range_rms_m = 0.0;  ///< along the beams
  double plane_rms_m = 0.0;  ///< distances from the boards' planes
  int returns = 0;
  /// How far a linear solution without start lies from the answer; none for returns that do not lie
  /// in one plane of the lidar. A check: only gross errors of the association show in it.
  struct CrossCheck {
    double turn_rad = 0.0;
    double shift_m = 0.0;
  };
  std::optional<CrossCheck> linear;
  std::vector<std::string> notes;
};

/// camera_from_lidar, Eq. (6), and the offset of the ranges, from returns of boards whose places
/// `start` knows; of `start` only the lidar changes. Which returns are of a board is found from the
/// start, again and again as it gets better. Fails with kTooFewPoints where they are too few, or do
/// not say all six degrees of freedom, and says what to record.
Result<LidarCalibration> CalibrateLidar(const BoardMount& mount, const ChainState& start,
                                        const std::vector<LidarProfile>& profiles,
                                        const LidarCalibrationOptions& options,
                                        const RunContext& context);

/// Returns within `gate_sigmas` of their boards.
std::vector<BoardHits> WithinGate(const ChainData& data, const ChainState& state,
                                  const std::vector<BoardHits>& hits, double gate_sigmas);

struct TimeCalibration {
  ChainState state;
  std::vector<BoardHits> hits;  ///< of the sweeps
  std::vector<MotorTrack> tracks;
  ChainFit fit;
  double sigma_s = 0.0;   ///< of the stamp offset, axis and angles taken as exact
  double up_ratio = 0.0;  ///< of the returns on boards while the motor turned upwards
};

/// The offset of the lidar's stamps against the encoder's, together with the lidar's pose, from
/// sweeps up and down; beams get the motor's angle at their own time. `still` are the stops'
/// returns. Fails with kTooFewPoints where there is no sweep, and with kInvalidInput for one that
/// goes one way only: there an offset in time is the same as a turn of the lidar about the motor's
/// axis, and no residual shows it.
Result<TimeCalibration> CalibrateTime(const CalibrationSession& session, const ChainState& start,
                                      const std::vector<BoardHits>& still, double range_sigma_m,
                                      const LidarCalibrationOptions& options,
                                      const RunContext& context);

}  // namespace foresight
