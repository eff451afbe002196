#include "core/fitting/valve/refine.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/fitting/valve/valve_tracer.h"

namespace foresight {
namespace {

constexpr double kCauchyScale2 = 4.0;  // of the squared pair of residuals: 2 sigma
constexpr double kGate = 2.5;          // sigmas of range within which a ray saw the template
constexpr double kStep = 1e-5;         // of the numeric derivative, metres and radians
constexpr int kPriors = 8;

constexpr double kLeastFraction = 0.5;  // of the footprint of a ray that saw the template

/// What a ray says about the template while a round lasts.
enum class Role { kSurface, kFree, kNothing };

struct RoledRay {
  std::size_t index;
  Role role;
};

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

class Problem {
 public:
  Problem(const BeamFootprints& footprints, const RefineOptions& options)
      : rays_(footprints.Rays()), options_(options), footprints_(footprints) {
    const RaySet& rays = rays_;
    const std::size_t stride = std::max<std::size_t>(
        1, (rays.rays.size() + static_cast<std::size_t>(options.max_rays) - 1) /
               static_cast<std::size_t>(options.max_rays));
    for (std::size_t i = 0; i < rays.rays.size(); i += stride)
      roled_.push_back({i, Role::kNothing});
    weight_ = std::min(1.0, rays.samples_per_ray) * static_cast<double>(rays.rays.size()) /
              static_cast<double>(roled_.size());
  }

  void AssignRoles(const ValveCandidate& valve) {
    const ValveTracer tracer(valve, options_.parts);
    for (RoledRay& roled : roled_) {
      const double range_m = rays_.rays[roled.index].range_m;
      const ValveIntersection intersection = tracer.Intersect(rays_.rays[roled.index]);
      const ExpectedRange expected =
          footprints_.Expect(roled.index, intersection, valve.brightness);
      const double behind = range_m - intersection.middle_m;
      // A range nearer to the wall's than to the template's says nothing of the template.
      const double from_wall = std::abs(range_m - footprints_.WallRange(roled.index));
      const bool on_template = std::abs(behind) < std::min(kGate * footprints_.Sigma(), from_wall);
      const bool between = expected.fraction > kLeastFraction && expected.gap_m > 0.0 &&
                           std::abs(range_m - expected.range_m) < kGate * expected.sigma_m;
      roled.role = on_template || between                ? Role::kSurface
                   : behind > 0.0 && options_.free_space ? Role::kFree
                                                         : Role::kNothing;
    }
  }

  /// Two residuals a ray, then the priors.
  Eigen::VectorXd Residuals(const ValveCandidate& valve) const {
    const ValveTracer tracer(valve, options_.parts);
    Eigen::VectorXd residuals = Eigen::VectorXd::Zero(2 * std::ssize(roled_) + kPriors);
    for (Eigen::Index i = 0; i < std::ssize(roled_); ++i) {
      const RoledRay& roled = roled_[static_cast<std::size_t>(i)];
      if (roled.role == Role::kNothing) continue;
      const RangeRay& ray = rays_.rays[roled.index];
      const ValveIntersection intersection = tracer.Intersect(ray);
      const double lateral_m = footprints_.HalfWidth(roled.index, intersection.across);
      if (roled.role == Role::kSurface) {
        const ExpectedRange expected =
            footprints_.Expect(roled.index, intersection, valve.brightness, kLeastFraction);
        residuals[2 * i] = (ray.range_m - expected.range_m) / expected.sigma_m;
        residuals[2 * i + 1] = std::max(0.0, intersection.Clearance()) / lateral_m;
      } else {
        residuals[2 * i] = std::max(0.0, -intersection.Clearance()) / lateral_m;
      }
    }
    residuals.tail<kPriors>() << (valve.model.tube_radius_m - ValvePrior::kTubeRadius_m) /
                                     ValvePrior::kTubeRadiusSigma_m,
        OwnSizeResidual(valve.model), std::log(valve.brightness) / ValvePrior::kBrightnessSigma,
        AxisPriorResiduals(valve, footprints_.Wall()), SectionResiduals(valve.model);
    return residuals;
  }

  double Cost(const Eigen::VectorXd& residuals) const {
    double cost = residuals.tail<kPriors>().squaredNorm();
    for (Eigen::Index i = 0; i < std::ssize(roled_); ++i)
      cost += weight_ * kCauchyScale2 *
              std::log1p(residuals.segment<2>(2 * i).squaredNorm() / kCauchyScale2);
    return cost;
  }

  /// Gauss-Newton's normal equations with Cauchy's weights.
  void Linearise(const ValveCandidate& valve, const Eigen::VectorXd& residuals,
                 ValveInformation& information, ValveStep& gradient) const {
    const Jacobian jacobian = JacobianAt(valve, residuals);
    const Eigen::VectorXd weights = WeightsOf(residuals);
    information = jacobian.transpose() * weights.asDiagonal() * jacobian;
    gradient = jacobian.transpose() * weights.cwiseProduct(residuals);
  }

  ValveScores Scores(const ValveCandidate& valve) const {
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

 private:
  using Jacobian = Eigen::Matrix<double, Eigen::Dynamic, kValveParameters>;

  Jacobian JacobianAt(const ValveCandidate& valve, const Eigen::VectorXd& residuals) const {
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
  bool Unseen(const ValveModel& model, int parameter) const {
    const bool section = parameter >= kRimDepth;
    if (model.IsLever()) return section;
    // Alone, a rim would thicken to reach the returns of its spokes.
    if (options_.parts == ValveParts::kRim)
      return section || parameter == kPhase || parameter == kTubeRadius || parameter == kDish;
    return model.spokes == 0 && (parameter == kSpokeRadius || parameter == kSpokeDepth);
  }

  /// A ray that goes from one part to another within a derivative's step seems to know the pose to
  /// a micrometre: it says nothing.
  static void DropSteps(Jacobian& jacobian) {
    constexpr double kMostSlope = 2000.0;  // deviations a metre: ten times those of 5 mm of noise
    for (Eigen::Index row = 0; row < jacobian.rows() - kPriors; ++row)
      if (!(jacobian.row(row).cwiseAbs().maxCoeff() < kMostSlope)) jacobian.row(row).setZero();
  }

  Eigen::VectorXd WeightsOf(const Eigen::VectorXd& residuals) const {
    Eigen::VectorXd weights = Eigen::VectorXd::Ones(residuals.size());
    for (Eigen::Index i = 0; i < std::ssize(roled_); ++i)
      weights.segment<2>(2 * i).setConstant(
          weight_ / (1.0 + residuals.segment<2>(2 * i).squaredNorm() / kCauchyScale2));
    return weights;
  }

  const RaySet& rays_;
  const RefineOptions& options_;
  const BeamFootprints& footprints_;
  std::vector<RoledRay> roled_;
  double weight_ = 1.0;  ///< measurements that one used ray stands for
};

}  // namespace

RefinedValve Refine(const BeamFootprints& footprints, const ValveCandidate& start,
                    const RefineOptions& options) {
  Problem problem(footprints, options);
  RefinedValve best{start, ValveInformation::Identity()};
  ValveStep gradient;
  for (int round = 0; round < options.rounds; ++round) {
    problem.AssignRoles(best.valve);
    Eigen::VectorXd residuals = problem.Residuals(best.valve);
    double cost = problem.Cost(residuals);
    double damping = 1e-3;
    for (int step = 0; step < options.steps; ++step) {
      problem.Linearise(best.valve, residuals, best.information, gradient);
      // A direction that no ray sees (the phase of a bare rim) must not make the system singular.
      ValveInformation damped = best.information;
      damped.diagonal() += damping * best.information.diagonal() + ValveStep::Constant(1e-3);
      const ValveCandidate tried = Retract(best.valve, damped.ldlt().solve(-gradient));
      const Eigen::VectorXd tried_residuals = problem.Residuals(tried);
      const double tried_cost = problem.Cost(tried_residuals);
      if (!(tried_cost < cost)) {
        damping *= 10.0;
        continue;
      }
      damping = std::max(1e-7, damping * 0.1);
      const bool settled = cost - tried_cost < 1e-4 * cost;
      best.valve = tried;
      residuals = tried_residuals;
      cost = tried_cost;
      if (settled) break;
    }
  }
  return best;
}

ValveScores ScoresOf(const BeamFootprints& footprints, const ValveCandidate& valve,
                     const RefineOptions& options) {
  Problem problem(footprints, options);
  problem.AssignRoles(valve);
  return problem.Scores(valve);
}

}  // namespace foresight
