#include "core/fitting/line_covariance.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "core/base/contract.h"

namespace foresight {

Eigen::MatrixXd SumsOfLines(std::span<const RangeRay> rays, const Eigen::MatrixXd& scores) {
  FORESIGHT_EXPECTS(scores.rows() == std::ssize(rays), "a row of scores for each ray");
  std::unordered_map<int, Eigen::Index> row_of_line;
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(scores.rows(), scores.cols());
  Eigen::Index count = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const int line = rays[i].cell.y();
    Eigen::Index row = count;
    if (line >= 0) row = row_of_line.try_emplace(line, count).first->second;
    count = std::max(count, row + 1);
    sums.row(row) += scores.row(static_cast<Eigen::Index>(i));
  }
  return sums.topRows(count);
}

Eigen::MatrixXd CovarianceClusteredByLine(std::span<const RangeRay> rays,
                                          const Eigen::MatrixXd& scores,
                                          const Eigen::MatrixXd& information,
                                          const Eigen::MatrixXd& prior_information) {
  const Eigen::Index size = information.rows();
  FORESIGHT_EXPECTS(scores.cols() == size, "a column of scores for each parameter");
  const Eigen::MatrixXd sums = SumsOfLines(rays, scores);
  const double lines = std::max(2.0, static_cast<double>(sums.rows()));
  const Eigen::MatrixXd scatter =
      lines / (lines - 1.0) * sums.transpose() * sums + prior_information;
  // With information = L L^T the sandwich is L^-T M L^-1, and M would be 1 if beams were
  // independent: its eigenvalues say how much less is known in each direction.
  const Eigen::LLT<Eigen::MatrixXd> root(information);
  const Eigen::MatrixXd half = root.matrixL().solve(scatter);
  const Eigen::MatrixXd inflation = root.matrixL().solve(half.transpose());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(0.5 *
                                                             (inflation + inflation.transpose()));
  const Eigen::MatrixXd at_least_one = eigen.eigenvectors() *
                                       eigen.eigenvalues().cwiseMax(1.0).asDiagonal() *
                                       eigen.eigenvectors().transpose();
  const Eigen::MatrixXd left = root.matrixU().solve(at_least_one);
  return root.matrixU().solve(left.transpose());
}

double DeviationsOverLines(std::span<const RangeRay> rays, const Eigen::VectorXd& differences) {
  const Eigen::VectorXd sums = SumsOfLines(rays, differences);
  const double scale = sums.norm();
  return scale > 0.0 ? sums.sum() / scale : 0.0;
}

}  // namespace foresight
