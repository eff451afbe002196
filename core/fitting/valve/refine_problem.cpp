#include "core/fitting/valve/refine_problem.h"

#include <algorithm>
#include <cmath>

#include "core/fitting/valve/valve_coverage.h"
#include "core/fitting/valve/valve_tracer.h"

namespace foresight {
namespace {

constexpr double kGate = 2.5;           // sigmas of range within which a ray saw the template
constexpr double kStep = 1e-5;          // of the numeric derivative, metres and radians
constexpr double kLeastFraction = 0.5;  // of the footprint of a ray that saw the template

/// The step of a one-sided derivative. A size at the end of its range can only change inwards: the
/// other way its clamp would hide the slope and the size would stay there for ever.
double StepTowardsUsual(const ValveModel& model, int parameter) {
  const Eigen::Vector3d sections = SectionResiduals(model);
  const bool above =
      (parameter == kTubeRadius && model.tube_radius_m > ValvePrior::kTubeRadius_m) ||
      (parameter == kDish && OwnSizeResidual(model) > 0.0) ||
      (parameter == kRimDepth && sections.x() > 0.0) ||
      (parameter == kSpokeRadius && sections.y() > 0.0) ||
      (parameter == kSpokeDepth && sections.z() > 0.0);
  return above ? -kStep : kStep;
}

}  // namespace

RefineProblem::RefineProblem(const BeamFootprints& footprints, const RefineOptions& options)
    : rays_(footprints.Rays()), options_(options), footprints_(footprints) {
  const RaySet& rays = rays_;
  const std::size_t stride =
      std::max<std::size_t>(1, (rays.rays.size() + static_cast<std::size_t>(options.max_rays) - 1) /
                                   static_cast<std::size_t>(options.max_rays));
  for (std::size_t i = 0; i < rays.rays.size(); i += stride) roled_.push_back({i, Role::kNothing});
  weight_ =
      rays.Worth() * static_cast<double>(rays.rays.size()) / static_cast<double>(roled_.size());
}

void RefineProblem::AssignRoles(const ValveCandidate& valve) {
  const ValveTracer tracer(valve, options_.parts);
  for (RoledRay& roled : roled_) {
    const double range_m = rays_.rays[roled.index].range_m;
    const ValveIntersection intersection = tracer.Intersect(rays_.rays[roled.index]);
    const ExpectedBeam expected = footprints_.Expect(
        roled.index, CoverageOf(footprints_, roled.index, intersection, valve.brightness));
    const double behind = range_m - intersection.middle_m;
    // A range nearer to the wall's than to the template's says nothing of the template.
    const double from_wall = std::abs(range_m - footprints_.BackgroundRange(roled.index));
    const bool on_template = std::abs(behind) < std::min(kGate * footprints_.Sigma(), from_wall);
    // A disc has no sides: nothing of a footprint lies beside it.
    const bool between = intersection.part != ValvePart::kDisc &&
                         expected.fraction > kLeastFraction && expected.mixed &&
                         std::abs(range_m - expected.range_m) < kGate * expected.sigma_m;
    roled.role = on_template || between                ? Role::kSurface
                 : behind > 0.0 && options_.free_space ? Role::kFree
                                                       : Role::kNothing;
  }
}

Eigen::VectorXd RefineProblem::Residuals(const ValveCandidate& valve) const {
  const ValveTracer tracer(valve, options_.parts);
  Eigen::VectorXd residuals = Eigen::VectorXd::Zero(2 * std::ssize(roled_) + kPriors);
  for (Eigen::Index i = 0; i < std::ssize(roled_); ++i) {
    const RoledRay& roled = roled_[static_cast<std::size_t>(i)];
    if (roled.role == Role::kNothing) continue;
    const RangeRay& ray = rays_.rays[roled.index];
    if (roled.role == Role::kFree) {
      const ValveIntersection intersection = tracer.Intersect(ray, 0.0);
      if (intersection.Clearance() < 0.0)
        residuals[2 * i] = -intersection.Clearance() /
                           footprints_.HalfWidthAlong(roled.index, intersection.across);
      continue;
    }
    const ValveIntersection intersection = tracer.Intersect(ray);
    BeamCoverage coverage = CoverageOf(footprints_, roled.index, intersection, valve.brightness);
    coverage.fraction = std::max(coverage.fraction, kLeastFraction);
    const ExpectedBeam expected = footprints_.Expect(roled.index, coverage);
    residuals[2 * i] = (ray.range_m - expected.range_m) / expected.sigma_m;
    if (intersection.Clearance() > 0.0)
      residuals[2 * i + 1] =
          intersection.Clearance() / footprints_.HalfWidthAlong(roled.index, intersection.across);
  }
  residuals.tail<kPriors>() << (valve.model.tube_radius_m - ValvePrior::kTubeRadius_m) /
                                   ValvePrior::kTubeRadiusSigma_m,
      OwnSizeResidual(valve.model), std::log(valve.brightness) / ValvePrior::kBrightnessSigma,
      AxisPriorResiduals(valve, footprints_.Background()), SectionResiduals(valve.model);
  return residuals;
}

double RefineProblem::Cost(const Eigen::VectorXd& residuals) const {
  double cost = residuals.tail<kPriors>().squaredNorm();
  for (Eigen::Index i = 0; i < std::ssize(roled_); ++i)
    cost += weight_ * kCauchyScale2 *
            std::log1p(residuals.segment<2>(2 * i).squaredNorm() / kCauchyScale2);
  return cost;
}

void RefineProblem::Linearise(const ValveCandidate& valve, const Eigen::VectorXd& residuals,
                              ValveInformation& information, ValveStep& gradient) const {
  const Jacobian jacobian = JacobianAt(valve, residuals);
  const Eigen::VectorXd weights = WeightsOf(residuals);
  information = jacobian.transpose() * weights.asDiagonal() * jacobian;
  gradient = jacobian.transpose() * weights.cwiseProduct(residuals);
}

ValveScores RefineProblem::Scores(const ValveCandidate& valve) const {
  const Eigen::VectorXd residuals = Residuals(valve);
  Jacobian jacobian = JacobianAt(valve, residuals);
  DropSteps(jacobian);
  const Eigen::VectorXd weights = WeightsOf(residuals);
  const Eigen::VectorXd pull = -weights.cwiseProduct(residuals);
  const Jacobian pulls = pull.asDiagonal() * jacobian;
  ValveScores scores;
  scores.information = jacobian.transpose() * weights.asDiagonal() * jacobian;
  scores.prior = jacobian.bottomRows<kPriors>().transpose() * jacobian.bottomRows<kPriors>();
  scores.scores.resize(std::ssize(roled_), int{kValveParameters});
  for (Eigen::Index i = 0; i < std::ssize(roled_); ++i) {
    scores.rays.push_back(rays_.rays[roled_[static_cast<std::size_t>(i)].index]);
    scores.scores.row(i) = pulls.row(2 * i) + pulls.row(2 * i + 1);
  }
  return scores;
}

RefineProblem::Jacobian RefineProblem::JacobianAt(const ValveCandidate& valve,
                                                  const Eigen::VectorXd& residuals) const {
  Jacobian jacobian(residuals.size(), int{kValveParameters});
  for (int p = 0; p < kValveParameters; ++p) {
    if (Unseen(valve.model, p)) {
      jacobian.col(p).setZero();
      continue;
    }
    const double step = StepTowardsUsual(valve.model, p);
    jacobian.col(p) = (Residuals(Retract(valve, step * ValveStep::Unit(p))) - residuals) / step;
  }
  return jacobian;
}

/// Whether a parameter changes nothing that is looked at.
bool RefineProblem::Unseen(const ValveModel& model, int parameter) const {
  const bool section = parameter >= kRimDepth;
  if (model.IsLever()) return section;
  // Alone, a rim would thicken to reach the returns of its spokes.
  if (options_.parts == ValveParts::kRim)
    return section || parameter == kPhase || parameter == kTubeRadius || parameter == kDish;
  return model.spokes == 0 && (parameter == kSpokeRadius || parameter == kSpokeDepth);
}

/// A ray that goes from one part to another within a derivative's step seems to know the pose to
/// a micrometre: it says nothing.
void RefineProblem::DropSteps(Jacobian& jacobian) {
  constexpr double kMostSlope = 2000.0;  // deviations a metre: ten times those of 5 mm of noise
  for (Eigen::Index row = 0; row < jacobian.rows() - kPriors; ++row)
    if (!(jacobian.row(row).cwiseAbs().maxCoeff() < kMostSlope)) jacobian.row(row).setZero();
}

Eigen::VectorXd RefineProblem::WeightsOf(const Eigen::VectorXd& residuals) const {
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(residuals.size());
  for (Eigen::Index i = 0; i < std::ssize(roled_); ++i)
    weights.segment<2>(2 * i).setConstant(
        weight_ / (1.0 + residuals.segment<2>(2 * i).squaredNorm() / kCauchyScale2));
  return weights;
}

}  // namespace foresight
