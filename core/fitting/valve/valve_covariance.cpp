#include "core/fitting/valve/valve_covariance.h"

#include <array>
#include <limits>

#include "core/fitting/line_covariance.h"
#include "core/fitting/valve/valve_evidence.h"

namespace foresight {
namespace {

// What no ray tells, that wheels are no template, along and about x, y and z: the deviations of the
// rays are multiplied. Chosen so that the spread over predicted of `evaluate-fits valve
// --first-seed 1 --count 150 --only positives --source raw` is near 1; with factors of 1 it
// is 1.5, 1.5, 2.5, 1.2, 1.3 and 0.8. Along the axis it is 1.8 to 2.7 in each quarter of the
// deviations: a factor, and nothing that is added.
constexpr std::array<double, 6> kFactors = {1.5, 1.6, 2.4, 1.25, 1.25, 1.0};

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
  SetCovariance(widened, detection);
}

}  // namespace foresight
