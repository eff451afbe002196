#pragma once

#include "core/calibration/chain_state.h"

namespace foresight {

/// Valid returns of one line of the lidar, or of the mean of all lines of a stop, in the order of
/// their beams.
struct LidarProfile {
  int pose = BoardHits::kNone;
  int visit = BoardHits::kNone;  ///< kNone in a sweep
  int stop = BoardHits::kNone;
  std::vector<LidarReturn> returns;
};

/// Standard deviation of single ranges about their beam's median, from stops with at least 5 lines;
/// NaN where there is none. Spikes and edges do not count.
double RangeSigmaOf(const CalibrationSession& session);

/// A profile a stop: each beam's mean over the lines, after spikes are left out; its sigma is that
/// of a mean, and never below `floor_m`.
std::vector<LidarProfile> ProfilesOfStops(const CalibrationSession& session,
                                          const std::vector<double>& stops_rad,
                                          double range_sigma_m, double floor_m);

/// A profile a line of the sweeps.
std::vector<LidarProfile> ProfilesOfSweeps(const CalibrationSession& session, double range_sigma_m);

/// How returns are told to belong to a board.
struct AssociationOptions {
  double margin_m = 0.020;     ///< how far inside the board's outline a return must be predicted
  double depth_m = 0.060;      ///< how near its plane
  double most_tilt_rad = 0.5;  ///< of the line of returns against the predicted plane
  int least_returns = 8;
  /// Only the longest run of returns on one straight line; false where the poses are known so well
  /// that a gate on the residuals does.
  bool straight_line = true;
  std::uint64_t seed = 1;

  Status Check() const;
};

/// The returns of each profile that lie on the boards of the stand: those whose beams are predicted
/// to meet a board inside its outline and that lie near its plane, of them the straight line that
/// most agree with (RANSAC), of it the longest run of neighbours. O(returns).
std::vector<BoardHits> AssociateReturns(const BoardMount& mount, const ChainData& tracks,
                                        const ChainState& state,
                                        const std::vector<LidarProfile>& profiles,
                                        const AssociationOptions& options);

}  // namespace foresight
