#include "core/fitting/cylinder/cylinder_state.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/fitting/solids/pattern_search.h"
#include "core/fitting/solids/solid_coverage.h"
#include "core/fitting/solids/solid_tracer.h"
#include "core/geometry/rotation_between.h"

namespace foresight {

SolidPart CylinderState::Part() const {
  SolidPart part;
  part.name = "cylinder";
  part.shape = SolidPart::Shape::kCylinder;
  part.size_m = {2.0 * radius_m, 2.0 * radius_m, length_m};
  part.object_from_part = {RotationBetween(Eigen::Vector3d::UnitZ(), axis), middle};
  return part;
}

BeamOptions CylinderBeams(const RaySet& rays) {
  BeamOptions options = kRoundCylinderBeams;
  if (!(rays.footprint_height_rad > 0.0)) return options;
  // Between 0, which simulated pipes want, and 0.5, which the one real post wants (KITTI's: that
  // post is no judge of this number).
  options.early_return = 0.25;
  options.samples = 3;
  options.mixed_ranges = true;
  return options;
}

double LogLikelihoodOf(const SolidPart& solid_in_base, const BeamLikelihood& likelihood) {
  return likelihood(CoverAllBy(SolidTracer({&solid_in_base, 1}, {})));
}

CylinderState Retract(const CylinderState& cylinder, const CylinderStep& step) {
  const Eigen::Vector3d x = cylinder.axis.unitOrthogonal();
  const Eigen::Vector3d y = cylinder.axis.cross(x);
  CylinderState retracted = cylinder;
  retracted.axis = (cylinder.axis + step[2] * x + step[3] * y).normalized();
  retracted.middle += step[0] * x + step[1] * y + 0.5 * (step[5] + step[6]) * retracted.axis;
  retracted.radius_m += step[4];
  retracted.length_m += step[6] - step[5];
  return retracted;
}

double ScoreOf(const CylinderState& cylinder, const BeamLikelihood& likelihood,
               const CylinderBounds& bounds) {
  if (cylinder.radius_m < bounds.min_radius_m || cylinder.radius_m > bounds.max_radius_m ||
      cylinder.length_m < 0.5 * cylinder.radius_m)
    return -std::numeric_limits<double>::infinity();
  return LogLikelihoodOf(cylinder.Part(), likelihood);
}

CylinderState AfterLocalSearch(const CylinderState& cylinder, const BeamLikelihood& likelihood,
                               const CylinderBounds& bounds, double first_step_m, int rounds) {
  const double lever_m = std::max(0.5 * cylinder.length_m, cylinder.radius_m);
  CylinderStep lengths;
  lengths << first_step_m, first_step_m, first_step_m / lever_m, first_step_m / lever_m,
      first_step_m, 2.0 * first_step_m, 2.0 * first_step_m;
  PatternSearchOptions options;
  options.rounds = rounds;
  for (int i = 0; i < kCylinderParameters; ++i)
    options.steps.push_back(lengths[i] * Eigen::VectorXd::Unit(kCylinderParameters, i));
  // Radius and place along the line of sight trade with each other: one step for both.
  const Eigen::Vector3d away =
      cylinder.FromAxis(likelihood.rays().viewpoint).normalized() * -first_step_m;
  const Eigen::Vector3d x = cylinder.axis.unitOrthogonal();
  Eigen::VectorXd deeper = Eigen::VectorXd::Zero(kCylinderParameters);
  deeper[0] = away.dot(x);
  deeper[1] = away.dot(cylinder.axis.cross(x));
  deeper[4] = first_step_m;
  options.steps.push_back(deeper);
  const PatternSearchResult found = ClimbByPatternSearch(
      Eigen::VectorXd::Zero(kCylinderParameters),
      [&](const Eigen::VectorXd& step) {
        return ScoreOf(Retract(cylinder, step), likelihood, bounds);
      },
      options);
  CylinderState searched = Retract(cylinder, found.values);
  searched.score = found.score;
  return searched;
}

}  // namespace foresight
