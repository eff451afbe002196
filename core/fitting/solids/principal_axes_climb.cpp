#include "core/fitting/solids/principal_axes_climb.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <utility>
#include <vector>

namespace foresight {
namespace {

constexpr int kGaussNewtonSteps = 2;
constexpr double kShortestStep = 0.25;  // of a Gauss-Newton step
constexpr double kFirstStep_sigmas = 2.0;
constexpr int kRounds = 3;

/// Whether a part of the Gauss-Newton step leads up; then `best` is there.
bool GaussNewtonStep(const ScoreShape& shape,
                     const std::function<double(const Eigen::VectorXd&)>& score,
                     PatternSearchResult& best) {
  const Eigen::VectorXd step = shape.information.ldlt().solve(shape.gradient);
  if (!step.allFinite()) return false;
  for (double length = 1.0; length >= kShortestStep; length *= 0.5) {
    Eigen::VectorXd tried = best.values + length * step;
    const double tried_score = score(tried);
    if (!(tried_score > best.score)) continue;
    best = {std::move(tried), tried_score};
    return true;
  }
  return false;
}

/// Along the axes of the parameters' correlations, which do not depend on their units.
std::vector<Eigen::VectorXd> PrincipalSteps(const Eigen::MatrixXd& information) {
  const Eigen::VectorXd unit = information.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(unit.asDiagonal() * information *
                                                            unit.asDiagonal());
  std::vector<Eigen::VectorXd> steps;
  for (Eigen::Index i = 0; i < unit.size(); ++i) {
    const double sigmas = kFirstStep_sigmas / std::sqrt(axes.eigenvalues()[i]);
    Eigen::VectorXd step = sigmas * unit.cwiseProduct(axes.eigenvectors().col(i));
    if (step.allFinite()) steps.push_back(std::move(step));
  }
  return steps;
}

}  // namespace

PatternSearchResult ClimbAlongPrincipalAxes(
    const PatternSearchResult& start, const std::function<double(const Eigen::VectorXd&)>& score,
    const std::function<ScoreShape(const Eigen::VectorXd&)>& shape_at) {
  PatternSearchResult best = start;
  ScoreShape shape = shape_at(best.values);
  for (int i = 0; i < kGaussNewtonSteps && GaussNewtonStep(shape, score, best); ++i)
    shape = shape_at(best.values);
  PatternSearchOptions options;
  options.steps = PrincipalSteps(shape.information);
  options.rounds = kRounds;
  return ClimbByPatternSearch(best.values, score, options);
}

}  // namespace foresight
