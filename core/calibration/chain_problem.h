#pragma once

#include "core/base/run_context.h"
#include "core/calibration/chain_state.h"

namespace foresight {

/// Which unknowns of the chain a solve may change.
struct FreeUnknowns {
  bool camera = false;
  bool views = false;   ///< poses of intrinsic images
  bool head = false;    ///< camera_from_head but for the gauge, A_theta, poses of the stand
  bool jitter = false;  ///< a visit's own angle
  bool mount = false;   ///< a_from_b
  bool lidar = false;   ///< camera_from_lidar
  bool range_offset = false;
  bool stamp_offset = false;
};

/// Standard deviations of what is measured, and of what is assumed.
struct ChainNoise {
  double corner_px = 0.287;            ///< an axis
  double repeatability_rad = 1.75e-4;  ///< of a stop, 0.01 deg
  double range_offset_m = 0.020;       ///< prior about 0

  Status Check() const;
};

/// What a lidar point on a board costs.
enum class LidarResidual {
  kRange,          ///< along the beam: unbiased, as the noise is
  kPerpendicular,  ///< Eq. (6) as printed
};

struct ChainSolveOptions {
  FreeUnknowns free;
  ChainNoise noise;
  LidarResidual residual = LidarResidual::kRange;
  /// Ranges beyond this many deviations count linearly (Huber); 0 = all squared.
  double huber_sigmas = 0.0;
  int max_iterations = 50;
};

/// An unknown that all measurements share, as the covariance has it.
struct SharedUnknown {
  std::string name;      ///< "fx", "axis turn y", "plate angle at -30 deg", ...
  std::string in_words;  ///< "the camera's focal length in x"
  std::string unit;      ///< "px", "rad", "m", "s", "" for a lens parameter
  std::string hint;      ///< what to record to know it better
};

struct ChainFit {
  double cost = 0.0;  ///< sum of squared residuals in deviations, priors included
  int residuals = 0;  ///< priors included
  int unknowns = 0;
  int iterations = 0;

  double ReducedChiSquare() const {
    return cost / static_cast<double>(std::max(1, residuals - unknowns));
  }
};

/// Covariance of the shared unknowns with all others free: the inverse of J^T J, its other
/// unknowns eliminated.
struct ChainCovariance {
  std::vector<SharedUnknown> unknowns;
  Eigen::MatrixXd matrix;  ///< in the unknowns' units

  double Sigma(int i) const { return std::sqrt(matrix(i, i)); }
  /// -1 where there is none of that name.
  int Find(const std::string& name) const;
};

/// Least squares over corners, lidar returns and priors (Levenberg-Marquardt, Ceres). `state` is
/// the start and the answer. Fails with kNoConvergence, leaving `state` as it was, and kCancelled.
Result<ChainFit> SolveChain(const ChainData& data, const ChainSolveOptions& options,
                            ChainState* state, const RunContext& context);

/// Covariance at `state`, a minimum. Fails with kTooFewPoints where the data leave a direction
/// open, naming the unknown that is part of it most.
Result<ChainCovariance> CovarianceOfChain(const ChainData& data, const ChainSolveOptions& options,
                                          const ChainState& state);

/// How far a return lies from its board, measured minus predicted range in metres; NaN where the
/// beam does not meet the board's plane or the motor's track has no angle there.
std::vector<double> RangeResiduals(const ChainData& data, const ChainState& state,
                                   const BoardHits& hits);

/// Measured minus predicted pixels; NaN where a corner has no image.
std::vector<Eigen::Vector2d> CornerResiduals(const ChainState& state, const CornerSet& corners);

}  // namespace foresight
