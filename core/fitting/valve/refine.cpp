#include "core/fitting/valve/refine.h"

#include <ceres/ceres.h>

#include <cmath>

#include "core/fitting/valve/refine_problem.h"

namespace foresight {
namespace {

/// All residuals and slopes at the point where Ceres is, computed once.
class PointOf final : public ceres::EvaluationCallback {
 public:
  PointOf(const RefineProblem& problem, const ValveCandidate& start)
      : problem_(problem), start_(start) {}

  void PrepareForEvaluation(bool slopes, bool new_point) override {
    valve_ = Retract(start_, step);
    if (new_point) residuals = problem_.Residuals(valve_);
    if (slopes) jacobian = problem_.JacobianAt(valve_, residuals);
  }

  ValveStep step = ValveStep::Zero();  ///< Ceres's parameters
  Eigen::VectorXd residuals;
  RefineProblem::Jacobian jacobian;

 private:
  const RefineProblem& problem_;
  const ValveCandidate& start_;
  ValveCandidate valve_;
};

/// Some of those residuals.
class PartOf final : public ceres::CostFunction {
 public:
  PartOf(const PointOf& point, Eigen::Index first, int count) : point_(point), first_(first) {
    set_num_residuals(count);
    mutable_parameter_block_sizes()->push_back(kValveParameters);
  }
  bool Evaluate(double const* const*, double* residuals, double** jacobians) const override {
    Eigen::Map<Eigen::VectorXd>(residuals, num_residuals()) =
        point_.residuals.segment(first_, num_residuals());
    if (jacobians != nullptr && jacobians[0] != nullptr)
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, kValveParameters, Eigen::RowMajor>>(
          jacobians[0], num_residuals(), kValveParameters) =
          point_.jacobian.middleRows(first_, num_residuals());
    return true;
  }

 private:
  const PointOf& point_;
  Eigen::Index first_;
};

}  // namespace

ValveCandidate Refine(const BeamFootprints& footprints, const ValveCandidate& start,
                      const RefineOptions& options) {
  RefineProblem rays(footprints, options);
  ValveCandidate valve = start;
  for (int round = 0; round < options.rounds; ++round) {
    rays.AssignRoles(valve);
    PointOf point(rays, valve);
    ceres::Problem::Options shape;
    shape.evaluation_callback = &point;
    shape.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ceres::Problem problem(shape);
    ceres::CauchyLoss cauchy(std::sqrt(RefineProblem::kCauchyScale2));
    ceres::ScaledLoss loss(&cauchy, rays.Weight(), ceres::DO_NOT_TAKE_OWNERSHIP);
    for (Eigen::Index i = 0; i < rays.Rays(); ++i)
      problem.AddResidualBlock(new PartOf(point, 2 * i, 2), &loss, point.step.data());
    problem.AddResidualBlock(new PartOf(point, 2 * rays.Rays(), RefineProblem::kPriors), nullptr,
                             point.step.data());
    ceres::Solver::Options solver;
    solver.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
    solver.max_num_iterations = options.steps;
    solver.function_tolerance = 1e-5;  // the next round asks anew what each ray saw
    solver.num_threads = 1;
    solver.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(solver, &problem, &summary);
    valve = Retract(valve, point.step);
  }
  return valve;
}

ValveInformation InformationAt(const BeamFootprints& footprints, const ValveCandidate& valve,
                               const RefineOptions& options) {
  RefineProblem problem(footprints, options);
  problem.AssignRoles(valve);
  ValveInformation information;
  ValveStep gradient;
  problem.Linearise(valve, problem.Residuals(valve), information, gradient);
  return information;
}

ValveScores ScoresOf(const BeamFootprints& footprints, const ValveCandidate& valve,
                     const RefineOptions& options) {
  RefineProblem problem(footprints, options);
  problem.AssignRoles(valve);
  return problem.Scores(valve);
}

}  // namespace foresight
