#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/fitting/beam_footprints.h"
#include "core/fitting/valve/refine.h"
#include "core/fitting/valve/valve_state.h"

namespace foresight {

/// The least squares of a valve's refinement: two residuals a ray, in deviations, then the priors.
/// What each ray saw (its role) is decided by AssignRoles and stays while a solver runs.
class RefineProblem {
 public:
  static constexpr int kPriors = 8;
  /// Of Cauchy's weight, for the squared length of a ray's pair of residuals: 2 deviations.
  static constexpr double kCauchyScale2 = 4.0;

  using Jacobian = Eigen::Matrix<double, Eigen::Dynamic, kValveParameters>;

  /// `footprints` must outlive this.
  RefineProblem(const BeamFootprints& footprints, const RefineOptions& options);

  /// Rays that are looked at.
  Eigen::Index Rays() const { return std::ssize(roled_); }
  /// Measurements that one of them stands for.
  double Weight() const { return weight_; }

  void AssignRoles(const ValveCandidate& valve);
  /// (2 Rays() + kPriors): the pairs, then the priors.
  Eigen::VectorXd Residuals(const ValveCandidate& valve) const;
  /// Their one-sided slopes by Retract's steps; `residuals` are those at `valve`.
  Jacobian JacobianAt(const ValveCandidate& valve, const Eigen::VectorXd& residuals) const;
  double Cost(const Eigen::VectorXd& residuals) const;
  /// Gauss-Newton's normal equations with Cauchy's weights.
  void Linearise(const ValveCandidate& valve, const Eigen::VectorXd& residuals,
                 ValveInformation& information, ValveStep& gradient) const;
  ValveScores Scores(const ValveCandidate& valve) const;

 private:
  /// What a ray says about the template.
  enum class Role { kSurface, kFree, kNothing };
  struct RoledRay {
    std::size_t index;
    Role role;
  };

  bool Unseen(const ValveModel& model, int parameter) const;
  static void DropSteps(Jacobian& jacobian);
  Eigen::VectorXd WeightsOf(const Eigen::VectorXd& residuals) const;

  const RaySet& rays_;
  const RefineOptions options_;
  const BeamFootprints& footprints_;
  std::vector<RoledRay> roled_;
  double weight_ = 1.0;
};

}  // namespace foresight
