#include "core/sensor/extended_unified_lens.h"

#include <fmt/format.h>

#include <cmath>

namespace foresight {

std::optional<ParameterFault> ExtendedUnifiedLens::FindFault() const {
  if (!(alpha >= 0.0 && alpha <= 1.0))
    return ParameterFault{"alpha", fmt::format("alpha {} is not in [0, 1]", alpha)};
  if (!(beta >= 0.01 && beta <= 100.0))
    return ParameterFault{"beta", fmt::format("beta {} is not in [0.01, 100]", beta)};
  return std::nullopt;
}

std::optional<Eigen::Vector2d> ExtendedUnifiedLens::Project(
    const Eigen::Vector3d& point, Eigen::Matrix<double, 2, 3>* by_point,
    Eigen::Matrix<double, 2, 2>* by_parameters) const {
  const double depth = point.z();
  const double across = std::sqrt(beta) * std::hypot(point.x(), point.y());
  const double d = std::hypot(across, depth);
  const double w = alpha <= 0.5 ? alpha / (1.0 - alpha) : (1.0 - alpha) / alpha;
  if (!(depth > -w * d)) return std::nullopt;
  const double denominator = alpha * d + (1.0 - alpha) * depth;
  if (!(denominator > 0.0)) return std::nullopt;
  const Eigen::Vector2d image = point.head<2>() / denominator;
  if (by_point != nullptr) {
    const Eigen::RowVector3d denominator_by_point(alpha * beta * point.x() / d,
                                                  alpha * beta * point.y() / d,
                                                  alpha * depth / d + 1.0 - alpha);
    *by_point = -image * denominator_by_point / denominator;
    (*by_point)(0, 0) += 1.0 / denominator;
    (*by_point)(1, 1) += 1.0 / denominator;
  }
  if (by_parameters != nullptr) {
    // d - Z cancels near the axis.
    const double d_minus_depth = depth > 0.0 ? across * across / (d + depth) : d - depth;
    by_parameters->col(0) = -image * d_minus_depth / denominator;
    by_parameters->col(1) = -image * (alpha * across * across / (2.0 * beta * d)) / denominator;
  }
  return image;
}

std::optional<Eigen::Vector3d> ExtendedUnifiedLens::Unproject(
    const Eigen::Vector2d& image_point) const {
  const double square = beta * image_point.squaredNorm();
  const double under_root = 1.0 - (2.0 * alpha - 1.0) * square;
  if (!(under_root > 0.0)) return std::nullopt;
  const double depth =
      (1.0 - alpha * alpha * square) / (alpha * std::sqrt(under_root) + 1.0 - alpha);
  return Eigen::Vector3d(image_point.x(), image_point.y(), depth).normalized();
}

}  // namespace foresight
