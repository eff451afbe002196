#include "core/calibration/chain_residuals.h"

#include <cmath>
#include <limits>
#include <map>

namespace foresight {
namespace {

/// Where the camera sees a return.
Eigen::Vector2d PixelOf(const ChainState& state, const LidarReturn& seen) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const Eigen::Vector3d point = (seen.range_m + state.range_offset_m) * seen.direction;
  return state.camera.Project(state.camera_from_lidar * point)
      .value_or(Eigen::Vector2d(kNone, kNone));
}

}  // namespace

std::vector<BoardFit> FitsOfBoards(const ChainCalibration& found) {
  std::map<std::pair<int, bool>, BoardFit> fits;
  const auto fit_of = [&fits](int pose, bool on_b) -> BoardFit& {
    BoardFit& fit = fits[{pose, on_b}];
    fit.pose = pose;
    fit.on_b = on_b;
    return fit;
  };
  for (const CornerSet& corners : found.data.corners) {
    if (corners.pose == CornerSet::kNone) continue;
    BoardFit& fit = fit_of(corners.pose, corners.on_b);
    for (const Eigen::Vector2d& residual : CornerResiduals(found.state, corners)) {
      if (!residual.allFinite()) continue;
      fit.rms_px += residual.squaredNorm();
      ++fit.corners;
    }
  }
  for (const BoardHits& hits : found.data.hits) {
    BoardFit& fit = fit_of(hits.pose, hits.on_b);
    for (const double residual : RangeResiduals(found.data, found.state, hits)) {
      if (!std::isfinite(residual)) continue;
      fit.rms_m += residual * residual;
      fit.mean_m += residual;
      ++fit.returns;
    }
  }
  std::vector<BoardFit> list;
  for (auto& [key, fit] : fits) {
    if (fit.corners > 0) fit.rms_px = std::sqrt(fit.rms_px / fit.corners);
    if (fit.returns > 0) {
      fit.rms_m = std::sqrt(fit.rms_m / fit.returns);
      fit.mean_m /= fit.returns;
    }
    list.push_back(fit);
  }
  return list;
}

std::vector<LidarImagePoint> LidarOnImages(const ChainCalibration& found, const SensorRig& prior) {
  ChainState before = found.state;
  before.camera_from_lidar = prior.camera_from_lidar;
  before.range_offset_m = prior.lidar.range_offset_m;
  std::vector<LidarImagePoint> points;
  for (const BoardHits& hits : found.data.hits) {
    if (hits.visit == BoardHits::kNone) continue;
    const std::vector<double> residuals_before = RangeResiduals(found.data, before, hits);
    const std::vector<double> residuals_after = RangeResiduals(found.data, found.state, hits);
    for (std::size_t i = 0; i < hits.returns.size(); ++i)
      points.push_back({hits.pose, hits.stop, hits.on_b, PixelOf(before, hits.returns[i]),
                        PixelOf(found.state, hits.returns[i]), residuals_before[i],
                        residuals_after[i]});
  }
  return points;
}

}  // namespace foresight
