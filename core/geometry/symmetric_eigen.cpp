#include "core/geometry/symmetric_eigen.h"

#include <Eigen/Eigenvalues>

namespace foresight {

SymmetricEigen EigenOf(const Eigen::MatrixXd& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(symmetric);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace foresight
