#pragma once

#include <Eigen/Core>

namespace foresight {

struct SymmetricEigen {
  Eigen::VectorXd values;   ///< ascending
  Eigen::MatrixXd vectors;  ///< of length 1, a column for each value
};

/// Eigenvalues and eigenvectors of a symmetric matrix; of its lower triangle, where it is not
/// quite. Not finite where the matrix is not.
///
/// Eigen's own, compiled once for all sizes: each file that calls it directly compiles it again.
SymmetricEigen EigenOf(const Eigen::MatrixXd& symmetric);

}  // namespace foresight
