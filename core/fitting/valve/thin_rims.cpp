#include "core/fitting/valve/thin_rims.h"

#include <algorithm>

#include "core/base/quantile.h"
#include "core/fitting/best_distinct.h"
#include "core/fitting/valve/valve_coverage.h"
#include "core/geometry/plane.h"

namespace foresight {
namespace {

// Trials and circles a plane, planes as fractions of the points that
// lie behind them, half widths that are tried.
constexpr int kThinTrials = 1500;
constexpr std::size_t kThinRims = 3;
constexpr double kThinTolerance_m = 0.015;
constexpr double kLeastClosing = 0.1;  // of a beam and a plane
constexpr double kSameRim = 0.03;      // of the radius, between places and between radii
constexpr double kLevels[] = {0.5, 0.75, 0.95};
constexpr double kTubes_m[] = {0.003, 0.006, 0.012};

/// The points as beams that all end on one plane across `facing`: where it has this fraction of the
/// points behind it. Beams that hardly reach it are left out.
std::vector<Eigen::Vector3d> OntoPlane(const std::vector<Eigen::Vector3d>& points,
                                       const Eigen::Vector3d& viewpoint,
                                       const Eigen::Vector3d& facing, double behind) {
  std::vector<double> levels;
  for (const Eigen::Vector3d& point : points) levels.push_back(facing.dot(point));
  const Plane plane{facing, Quantile(levels, behind)};
  const double before_plane_m = plane.Distance(viewpoint);
  std::vector<Eigen::Vector3d> on_plane;
  if (!(before_plane_m > 0.0)) return on_plane;
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d beam = (point - viewpoint).normalized();
    const double closing = -facing.dot(beam);
    if (closing > kLeastClosing) on_plane.push_back(viewpoint + before_plane_m / closing * beam);
  }
  return on_plane;
}

bool IsSameRim(const ValveCandidate& a, const ValveCandidate& b) {
  const double scale_m = kSameRim * std::max(a.model.rim_radius_m, b.model.rim_radius_m);
  return (a.base_from_object.translation() - b.base_from_object.translation()).norm() < scale_m &&
         std::abs(a.model.rim_radius_m - b.model.rim_radius_m) < scale_m;
}

}  // namespace

ValveCandidate RimFrom(const RimHypothesis& rim, double tube_radius_m) {
  return {PoseFromAxis(rim.center, rim.axis), UsualValve(rim.radius_m, tube_radius_m, 0, 0.0), 0.0};
}

void KeepDistinctRims(std::size_t most, std::vector<ValveCandidate>& rims) {
  KeepBestDistinct(most, &ValveCandidate::log_likelihood, IsSameRim, rims);
}

std::vector<ValveCandidate> SearchThinRims(const std::vector<Eigen::Vector3d>& points,
                                           const Eigen::Vector3d& viewpoint,
                                           const BeamLikelihood& coarse, RimSearchOptions search,
                                           Random& random) {
  search.trials = kThinTrials;
  search.keep = static_cast<int>(kThinRims);
  search.tolerance_m = kThinTolerance_m;
  std::vector<ValveCandidate> found;
  for (const double behind : kLevels)
    for (const RimHypothesis& rim :
         FindRims(OntoPlane(points, viewpoint, search.facing, behind), search, random))
      for (const double tube_radius_m : kTubes_m) {
        ValveCandidate thin = RimFrom(rim, tube_radius_m);
        thin.model.rim_depth_ratio = ValvePrior::kRimDepth_m / tube_radius_m;
        thin.log_likelihood = ScoreOf(thin, coarse, ValveParts::kRim);
        found.push_back(thin);
      }
  KeepDistinctRims(kThinRims, found);
  return found;
}

}  // namespace foresight
