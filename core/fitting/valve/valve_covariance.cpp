#include "core/fitting/valve/valve_covariance.h"

#include <array>
#include <limits>

#include "core/fitting/line_covariance.h"
#include "core/fitting/valve/valve_evidence.h"

namespace foresight {
namespace {

// What no ray tells, that wheels are no template, along and about x, y and z: the deviations of the
// rays are multiplied. Chosen so that the spreads over predicted of raw and foresight, which
// packaging/refit-verdicts prints of its training scenes, have a geometric mean near 1: with
// factors of 1.5, 1.6, 2.4, 1.25, 1.25 and 1 they were 0.97, 1.02, 0.99, 0.83, 0.81, 0.68 (raw)
// and 1.28, 1.09, 1.43, 0.98, 0.96, 0.50 (foresight) on seeds 1 to 600. The turn stays at 1: with
// 0.6, what new noise alone does to one wheel is four times what it says
// (test_core_fitting_covariance).
constexpr std::array<double, 6> kFactors = {1.7, 1.7, 2.9, 1.1, 1.1, 1.0};
// What all rays of a scan share and none tells: the head is not quite where it is believed to be,
// and its ranges walk. Across the axis and along it; chosen so that no root mean square of errors
// over deviations is far from 1 both at home and under varied conditions
// (docs/evaluation/valve.md, "Varied conditions").
constexpr double kSharedAcross_m = 0.0013;
constexpr double kSharedAlong_m = 0.0025;

}  // namespace

void WidenSigmas(const BeamFootprints& footprints, ValveDetection& detection) {
  RefineOptions all;
  all.max_rays = std::numeric_limits<int>::max();  // a thinned line would count for too much
  const ValveScores found = ScoresOf(footprints, detection.best, all);
  // The ridge bounds what no ray sees: a phase to a turn, a length to a metre.
  const ValveInformation ridge = ValveInformation::Identity();
  const Eigen::MatrixXd covariance = CovarianceClusteredByLine(
      found.rays, found.scores, found.information + ridge, found.prior + ridge);
  PoseCovariance widened = covariance.topLeftCorner<6, 6>();
  for (int i = 0; i < 6; ++i) {
    widened.row(i) *= kFactors[static_cast<std::size_t>(i)];
    widened.col(i) *= kFactors[static_cast<std::size_t>(i)];
  }
  const Eigen::Vector3d shared_m(kSharedAcross_m, kSharedAcross_m, kSharedAlong_m);
  widened.diagonal().head<3>() += shared_m.cwiseAbs2();
  SetCovariance(widened, detection);
}

}  // namespace foresight
