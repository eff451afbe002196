#include "core/evaluation/logistic_regression.h"

#include <Eigen/Dense>

namespace foresight {

Eigen::VectorXd LogisticWeights(const Eigen::MatrixXd& x, const Eigen::VectorXd& y,
                                const Eigen::VectorXd& counts, const Eigen::VectorXd& penalty) {
  constexpr int kNewtonSteps = 30;
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(x.cols());
  for (int step = 0; step < kNewtonSteps; ++step) {
    const Eigen::VectorXd p = (1.0 / (1.0 + (-(x * weights)).array().exp())).matrix();
    const Eigen::VectorXd curvature =
        (counts.array() * p.array() * (1.0 - p.array())).max(1e-9).matrix();
    const Eigen::VectorXd gradient =
        x.transpose() * counts.cwiseProduct(y - p) - penalty.cwiseProduct(weights);
    Eigen::MatrixXd hessian = x.transpose() * curvature.asDiagonal() * x;
    hessian.diagonal() += penalty;
    const Eigen::VectorXd change = hessian.ldlt().solve(gradient);
    weights += change;
    if (change.norm() < 1e-9) break;
  }
  return weights;
}

}  // namespace foresight
