#include "core/evaluation/sigma_errors.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>

namespace foresight {

void AddSigmaErrors(const Rigid<frame::Object, frame::Object>& found_from_truth,
                    const PoseCovariance& covariance, double period_rad,
                    std::vector<std::pair<std::string, double>>& errors) {
  constexpr std::array kNames = {"x", "y", "z", "tilt_x", "tilt_y", "turn_z"};
  const Eigen::Vector3d x = found_from_truth.Rotate(Eigen::Vector3d::UnitX());
  const double turns = std::round(std::atan2(x.y(), x.x()) / period_rad);
  const Eigen::AngleAxisd turn(found_from_truth.rotation() *
                               Eigen::AngleAxisd(-turns * period_rad, Eigen::Vector3d::UnitZ()));
  Eigen::Matrix<double, 6, 1> error;
  error << found_from_truth.translation(), turn.angle() * turn.axis();
  for (Eigen::Index i = 0; i < 6; ++i)
    if (const double variance = covariance(i, i); variance > 0.0)
      errors.emplace_back(std::string(kNames[static_cast<std::size_t>(i)]) + kSigmaErrorSuffix,
                          error[i] / std::sqrt(variance));
}

}  // namespace foresight
