#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/fitting/fit_origin.h"
#include "core/geometry/rigid.h"

namespace foresight::samples {

/// Errors of fitted poses against the covariances that the fits gave with them.
class PoseSpread {
 public:
  using Pose = Rigid<frame::Base, frame::Object>;
  using PoseError = Eigen::Matrix<double, 6, 1>;

  /// `sector_rad`: the object looks the same after such a turn about its z.
  void Add(const Pose& found, const PoseCovariance& covariance, const Pose& truth,
           double sector_rad = 2.0 * std::numbers::pi) {
    const Eigen::Vector3d x = (truth.Inverse() * found).Rotate(Eigen::Vector3d::UnitX());
    const double turns = std::round(std::atan2(x.y(), x.x()) / sector_rad);
    const Eigen::Matrix3d same_truth =
        truth.Matrix().topLeftCorner<3, 3>() *
        Eigen::AngleAxisd(turns * sector_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    const Eigen::Matrix3d turn = found.Matrix().topLeftCorner<3, 3>();
    const Eigen::AngleAxisd gap(Eigen::Matrix3d(same_truth.transpose() * turn));
    PoseError error;
    error << turn.transpose() * (found.translation() - truth.translation()),
        gap.angle() * gap.axis();
    errors_.push_back(error);
    covariances_.push_back(covariance);
  }

  std::size_t size() const { return errors_.size(); }
  /// The mean error: what a covariance of noise cannot know of.
  PoseError Mean() const {
    PoseError sum = PoseError::Zero();
    for (const PoseError& error : errors_) sum += error;
    return sum / static_cast<double>(errors_.size());
  }
  /// Mean squared distance of the estimates from their mean, in deviations, for each degree of
  /// freedom: 1 for a covariance that says how far estimates spread, 4 for deviations that are half
  /// of what they should be.
  double Ratio() const { return MeanSquare(Mean()) * Freedom(); }
  /// The same of the distances from the truth: what is always wrong counts, too.
  double RatioToTruth() const { return MeanSquare(PoseError::Zero()); }
  /// Ratio() of each degree of freedom alone.
  PoseError Ratios() const {
    const PoseError mean = Mean();
    PoseError sum = PoseError::Zero();
    for (std::size_t i = 0; i < errors_.size(); ++i)
      sum += ((errors_[i] - mean).array().square() / covariances_[i].diagonal().array()).matrix();
    return sum / static_cast<double>(errors_.size()) * Freedom();
  }

 private:
  /// The mean was taken from the same errors.
  double Freedom() const {
    const auto count = static_cast<double>(errors_.size());
    return count / (count - 1.0);
  }
  double MeanSquare(const PoseError& from) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < errors_.size(); ++i) {
      const PoseError gap = errors_[i] - from;
      sum += gap.dot(covariances_[i].ldlt().solve(gap));
    }
    return sum / (6.0 * static_cast<double>(errors_.size()));
  }

  std::vector<PoseError> errors_;
  std::vector<PoseCovariance> covariances_;
};

}  // namespace foresight::samples
