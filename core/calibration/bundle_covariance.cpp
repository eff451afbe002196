#include "core/calibration/bundle_covariance.h"

#include <cmath>

#include "core/geometry/symmetric_eigen.h"

namespace foresight {
namespace {

/// Relative to the largest, of unknowns scaled to 1: what is smaller is not observable.
constexpr double kSmallestEigenvalue = 1e-12;

/// The blocks of J^T J that one view adds.
struct ViewEquations {
  Eigen::MatrixXd shared;    ///< of the shared unknowns
  Eigen::MatrixXd coupling;  ///< shared by pose
  Eigen::Matrix<double, 6, 6> pose = Eigen::Matrix<double, 6, 6>::Zero();
  double squares = 0.0;
  int corners = 0;
};

ViewEquations Linearize(const CameraBundle& bundle, std::size_t view, bool free_warp) {
  const Eigen::Index values = bundle.camera.Values().size();
  const Eigen::Index count = values + (free_warp ? 2 : 0);
  ViewEquations equations{Eigen::MatrixXd::Zero(count, count), Eigen::MatrixXd::Zero(count, 6)};
  const Eigen::Matrix3d rotation = bundle.poses[view].RotationMatrix();
  const BoardView& seen = bundle.views[view];
  for (std::size_t i = 0; i < seen.pixels.size(); ++i) {
    const Eigen::Vector3d corner = bundle.board.Corner(seen.corner_ids[i], bundle.warp);
    CameraModel::ByPoint by_point;
    CameraModel::ByParameters by_values;
    const auto pixel = bundle.camera.Project(rotation * corner + bundle.poses[view].translation(),
                                             &by_point, &by_values);
    if (!pixel) continue;
    Eigen::MatrixXd by_shared(2, count);
    by_shared.leftCols(values) = by_values;
    if (free_warp)
      by_shared.rightCols<2>() =
          by_point * rotation.col(2) * bundle.board.CornerByWarp(seen.corner_ids[i]).transpose();
    const Eigen::Matrix<double, 2, 6> by_pose = by_point * ByPoseStep(rotation, corner);
    equations.shared += by_shared.transpose() * by_shared;
    equations.coupling += by_shared.transpose() * by_pose;
    equations.pose += by_pose.transpose() * by_pose;
    equations.squares += (*pixel - seen.pixels[i]).squaredNorm();
    ++equations.corners;
  }
  return equations;
}

/// The inverse; nullopt where the matrix has none, whatever the unknowns' units are.
std::optional<Eigen::MatrixXd> Inverse(const Eigen::MatrixXd& matrix) {
  const Eigen::VectorXd diagonal = matrix.diagonal();
  if (!(diagonal.minCoeff() > 0.0) || !diagonal.allFinite()) return std::nullopt;
  const Eigen::VectorXd scale = diagonal.cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * matrix * scale.asDiagonal();
  const auto [values, vectors] = EigenOf(scaled);
  if (!(values.minCoeff() > kSmallestEigenvalue * values.maxCoeff())) return std::nullopt;
  return scale.asDiagonal() * vectors * values.cwiseInverse().asDiagonal() * vectors.transpose() *
         scale.asDiagonal();
}

}  // namespace

std::optional<BundleCovariance> BundleCovariance::Of(const CameraBundle& bundle, bool free_warp) {
  BundleCovariance result;
  result.camera_ = bundle.camera;
  result.free_warp_ = free_warp;
  const Eigen::Index count = bundle.camera.Values().size() + (free_warp ? 2 : 0);
  Eigen::MatrixXd reduced = Eigen::MatrixXd::Zero(count, count);
  double squares = 0.0;
  int corners = 0;
  for (std::size_t view = 0; view < bundle.views.size(); ++view) {
    const ViewEquations equations = Linearize(bundle, view, free_warp);
    const auto pose = Inverse(equations.pose);
    if (!pose) return std::nullopt;
    const Eigen::MatrixXd coupling = equations.coupling * *pose;
    reduced += equations.shared - coupling * equations.coupling.transpose();
    squares += equations.squares;
    corners += equations.corners;
    result.views_.push_back({bundle.poses[view], coupling, *pose});
  }
  const auto shared = Inverse(reduced);
  const double freedom =
      2.0 * corners - 6.0 * static_cast<double>(bundle.views.size()) - static_cast<double>(count);
  if (!shared || freedom < 1.0) return std::nullopt;
  const double variance = squares / freedom;
  result.noise_px_ = std::sqrt(variance);
  result.shared_ = variance * *shared;
  for (ViewBlock& view : result.views_) view.covariance *= variance;
  return result;
}

CameraModel::Parameters BundleCovariance::ValueSigmas() const {
  return shared_.diagonal().head(camera_.Values().size()).cwiseSqrt();
}

Eigen::Vector2d BundleCovariance::WarpSigmas_m() const {
  if (!free_warp_) return Eigen::Vector2d::Zero();
  return shared_.diagonal().tail<2>().cwiseSqrt();
}

std::optional<Eigen::Matrix2d> BundleCovariance::OfProjection(const Eigen::Vector2d& pixel,
                                                              double distance_m) const {
  const auto ray = camera_.Unproject(pixel);
  if (!ray) return std::nullopt;
  const bool at_infinity = std::isinf(distance_m);
  const Eigen::Vector3d point = at_infinity ? *ray : Eigen::Vector3d(distance_m * *ray);
  CameraModel::ByPoint by_point;
  CameraModel::ByParameters by_values;
  if (!camera_.Project(point, &by_point, &by_values)) return std::nullopt;

  Eigen::MatrixXd by_shared = Eigen::MatrixXd::Zero(2, shared_.rows());
  by_shared.leftCols(by_values.cols()) = by_values;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  // The point stays where it is to each board; the mean of where the boards' new poses have it is
  // where it is now.
  const double weight = 1.0 / static_cast<double>(views_.size());
  for (const ViewBlock& view : views_) {
    const Eigen::Matrix3d rotation = view.pose.RotationMatrix();
    const Eigen::Vector3d in_pattern =
        rotation.transpose() *
        (at_infinity ? point : Eigen::Vector3d(point - view.pose.translation()));
    Eigen::Matrix<double, 3, 6> by_step = ByPoseStep(rotation, in_pattern);
    if (at_infinity) by_step.rightCols<3>().setZero();
    const Eigen::Matrix<double, 2, 6> by_pose = weight * by_point * by_step;
    by_shared -= by_pose * view.coupling.transpose();
    covariance += by_pose * view.covariance * by_pose.transpose();
  }
  return Eigen::Matrix2d(covariance + by_shared * shared_ * by_shared.transpose());
}

}  // namespace foresight
