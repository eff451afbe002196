#pragma once

#include <Eigen/Core>

namespace foresight {

/// The weights of a logistic regression, log odds = x w, by Newton's method on the penalised log
/// likelihood.
/// @param x one row an example; a constant is a column of ones
/// @param y 1 = it came true, 0
/// @param counts how many each example stands for
/// @param penalty of each weight's square, halved
Eigen::VectorXd LogisticWeights(const Eigen::MatrixXd& x, const Eigen::VectorXd& y,
                                const Eigen::VectorXd& counts, const Eigen::VectorXd& penalty);

}  // namespace foresight
