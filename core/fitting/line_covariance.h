#pragma once

#include <Eigen/Core>
#include <span>

#include "core/fitting/ray_set.h"

namespace foresight {

/// What the beams of one scan line say together: the rows of `scores` (one a ray, any number of
/// columns) summed over each line. A ray without a line (cell.y() < 0) is a line of its own.
/// @returns (lines x columns), in the order in which the lines first appear. O(rays).
/// @pre scores.rows() == rays.size()
Eigen::MatrixXd SumsOfLines(std::span<const RangeRay> rays, const Eigen::MatrixXd& scores);

/// Covariance of parameters whose estimate has this information (the negative second derivative of
/// the log likelihood, prior included) when the beams of one line err together: the sandwich
/// information^-1 (sum over lines of s s^T + prior) information^-1, with s a line's sum of
/// scores, the slopes of the log likelihood (White 1982; Liang and Zeger 1986). Lines are few, so
/// the sum is enlarged by lines / (lines - 1). Never below the inverse of the information in any
/// direction that both know: errors that happen to cancel are no knowledge. Units are those of the
/// parameters.
/// @pre scores.cols() == information.rows(); information is positive definite
Eigen::MatrixXd CovarianceClusteredByLine(std::span<const RangeRay> rays,
                                          const Eigen::MatrixXd& scores,
                                          const Eigen::MatrixXd& information,
                                          const Eigen::MatrixXd& prior_information);

/// How many deviations a difference of log likelihoods lies from 0 when the differences of single
/// lines, not of beams, are independent (Vuong 1989): sum / sqrt(sum of squares over lines). Two
/// models that a single line tells apart are 1 deviation apart, by however many nats. 0 where there
/// is no difference.
double DeviationsOverLines(std::span<const RangeRay> rays, const Eigen::VectorXd& differences);

}  // namespace foresight
