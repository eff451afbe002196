// What is known when the beams of a scan line err together.
#include "core/fitting/line_covariance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/base/random.h"

namespace foresight {
namespace {

constexpr int kLines = 20;
constexpr int kBeams = 30;

std::vector<RangeRay> Grid() {
  std::vector<RangeRay> rays;
  for (int line = 0; line < kLines; ++line)
    for (int beam = 0; beam < kBeams; ++beam) {
      RangeRay ray;
      ray.cell = {beam, line};
      rays.push_back(ray);
    }
  return rays;
}

struct MeanTrials {
  double spread = 0.0;     ///< mean square error of means
  double clustered = 0.0;  ///< mean of the variances that CovarianceClusteredByLine says
  double independent = 0.0;
};

/// The mean of errors of deviation 1, part of which all beams of a line share.
MeanTrials TryMeans(double shared_deviation) {
  constexpr int kTrials = 400;
  const std::vector<RangeRay> rays = Grid();
  const double n = static_cast<double>(rays.size());
  Random random(3);
  MeanTrials trials;
  for (int trial = 0; trial < kTrials; ++trial) {
    Eigen::VectorXd errors(std::ssize(rays));
    double shared = 0.0;
    for (Eigen::Index i = 0; i < errors.size(); ++i) {
      if (i % kBeams == 0) shared = shared_deviation * random.Normal();
      errors[i] = shared + random.Normal();
    }
    const double mean = errors.mean();
    const Eigen::MatrixXd scores = (errors.array() - mean).matrix();
    const Eigen::MatrixXd covariance = CovarianceClusteredByLine(
        rays, scores, Eigen::MatrixXd::Constant(1, 1, n), Eigen::MatrixXd::Zero(1, 1));
    trials.spread += mean * mean / kTrials;
    trials.clustered += covariance(0, 0) / kTrials;
  }
  trials.independent = 1.0 / n;
  return trials;
}

TEST(LineCovariance, IsTheSpreadWhenLinesErrAsOne) {
  const MeanTrials trials = TryMeans(1.0);
  // 400 trials know a variance to 7 %; it is 31 times what independent beams would have.
  EXPECT_NEAR(trials.clustered / trials.spread, 1.0, 0.2);
  EXPECT_GT(trials.spread, 20.0 * trials.independent);
}

TEST(LineCovariance, OfIndependentBeamsIsHardlyMoreThanTheInverseOfTheirInformation) {
  const MeanTrials trials = TryMeans(0.0);
  EXPECT_GE(trials.clustered, trials.independent);
  EXPECT_LT(trials.clustered, 1.4 * trials.independent);
}

TEST(LineCovariance, IsNeverBelowTheInverseOfTheInformation) {
  const std::vector<RangeRay> rays = Grid();
  Eigen::MatrixXd scores = Eigen::MatrixXd::Zero(std::ssize(rays), 2);
  for (Eigen::Index i = 0; i < scores.rows(); ++i) scores(i, 0) = i % kBeams == 0 ? 40.0 : 0.0;
  Eigen::Matrix2d information;
  information << 500.0, 100.0, 100.0, 300.0;
  const Eigen::MatrixXd more =
      CovarianceClusteredByLine(rays, scores, information, Eigen::MatrixXd::Zero(2, 2)) -
      information.inverse();
  EXPECT_GT(more(0, 0), 0.0);
  EXPECT_GT(more.eigenvalues().real().minCoeff(), -1e-9);
}

TEST(LineCovariance, ADifferenceThatOneLineMakesIsOneDeviation) {
  const std::vector<RangeRay> rays = Grid();
  Eigen::VectorXd differences = Eigen::VectorXd::Zero(std::ssize(rays));
  for (int beam = 0; beam < kBeams; ++beam) differences[beam] = 3.0;
  EXPECT_NEAR(DeviationsOverLines(rays, differences), 1.0, 1e-9);
  differences.setConstant(3.0);
  EXPECT_NEAR(DeviationsOverLines(rays, differences), std::sqrt(kLines), 1e-9);
  EXPECT_EQ(DeviationsOverLines(rays, Eigen::VectorXd::Zero(std::ssize(rays))), 0.0);
}

TEST(LineCovariance, RaysWithoutAGridAreLinesOfTheirOwn) {
  std::vector<RangeRay> rays(9);
  EXPECT_NEAR(DeviationsOverLines(rays, Eigen::VectorXd::Ones(9)), 3.0, 1e-9);
}

}  // namespace
}  // namespace foresight
