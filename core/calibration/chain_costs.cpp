#include "core/calibration/chain_costs.h"

#include <ceres/cost_function.h>

#include <cmath>

#include "core/base/contract.h"
#include "core/calibration/tangent.h"

namespace foresight::chain {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Block = Eigen::Map<RowMajor>;
using Eigen::Matrix3d;
using Eigen::RowVector3d;
using Eigen::Vector3d;

/// The derivatives by one block; empty where they are not wanted.
Block DerivativesBy(double** jacobians, std::size_t block, int rows, int columns) {
  const bool wanted = jacobians != nullptr && jacobians[block] != nullptr;
  Block map(wanted ? jacobians[block] : nullptr, wanted ? rows : 0, wanted ? columns : 0);
  map.setZero();
  return map;
}

CameraModel CameraFrom(const CameraModel& model, const double* values) {
  CameraModel::Parameters parameters = model.Values();
  for (Eigen::Index i = 0; i < parameters.size(); ++i) parameters[i] = values[i];
  return model.WithValues(parameters);
}

/// d point / d step of the pose that moved it there.
Eigen::Matrix<double, 3, 6> ByStep(const Matrix3d& rotation, const Vector3d& point_before) {
  Eigen::Matrix<double, 3, 6> by_step;
  by_step << -rotation * Skew(point_before), rotation;
  return by_step;
}

class ViewCost : public ceres::CostFunction {
 public:
  ViewCost(const CornerSet& corners, const CameraModel& camera, double sigma_px)
      : corners_(corners), camera_(camera), weight_(1.0 / sigma_px) {
    set_num_residuals(2 * static_cast<int>(corners.pixels.size()));
    *mutable_parameter_block_sizes() = {static_cast<int>(camera.Values().size()), 7};
  }

  bool Evaluate(const double* const* blocks, double* residuals, double** jacobians) const override {
    const int cameras = parameter_block_sizes()[0];
    const CameraModel camera = CameraFrom(camera_, blocks[0]);
    if (camera.FindFault()) return false;
    const auto pose = PoseOf<frame::Camera, frame::Pattern>(blocks[1]);
    const Matrix3d rotation = pose.RotationMatrix();
    Block by_camera = DerivativesBy(jacobians, 0, num_residuals(), cameras);
    Block by_pose = DerivativesBy(jacobians, 1, num_residuals(), 7);
    for (std::size_t i = 0; i < corners_.pixels.size(); ++i) {
      CameraModel::ByPoint by_point;
      CameraModel::ByParameters by_parameters;
      const auto pixel = camera.Project(pose * corners_.on_board[i], &by_point, &by_parameters);
      if (!pixel) return false;
      Eigen::Map<Eigen::Vector2d>(residuals + 2 * i) = weight_ * (*pixel - corners_.pixels[i]);
      const auto row = static_cast<Eigen::Index>(2 * i);
      if (by_camera.size() > 0) by_camera.middleRows<2>(row) = weight_ * by_parameters;
      if (by_pose.size() > 0)
        by_pose.block<2, 6>(row, 0) = weight_ * by_point * ByStep(rotation, corners_.on_board[i]);
    }
    return true;
  }

 private:
  CornerSet corners_;
  CameraModel camera_;
  double weight_;
};

class MountCost : public ceres::CostFunction {
 public:
  MountCost(const CornerSet& corners, const CameraModel& camera, int stops, double sigma_px)
      : corners_(corners), camera_(camera), weight_(1.0 / sigma_px) {
    set_num_residuals(2 * static_cast<int>(corners.pixels.size()));
    auto& sizes = *mutable_parameter_block_sizes();
    sizes = {static_cast<int>(camera.Values().size()), 7, stops, 1, 7};
    if (corners.on_b) sizes.push_back(7);
  }

  bool Evaluate(const double* const* blocks, double* residuals, double** jacobians) const override {
    const CameraModel camera = CameraFrom(camera_, blocks[0]);
    if (camera.FindFault()) return false;
    const auto head = PoseOf<frame::Camera, frame::Head>(blocks[1]);
    const auto turn = HeadFromBase(blocks[2][corners_.stop] + blocks[3][0]);
    const auto pose = PoseOf<frame::Base, frame::Pattern>(blocks[4]);
    const auto a_from_b = corners_.on_b ? PoseOf<frame::Pattern, frame::Pattern>(blocks[5])
                                        : Rigid<frame::Pattern, frame::Pattern>();
    const Matrix3d to_head = head.RotationMatrix();
    const Matrix3d to_base = to_head * turn.RotationMatrix();
    const Matrix3d to_a = to_base * pose.RotationMatrix();
    const Matrix3d to_b = to_a * a_from_b.RotationMatrix();

    const int rows = num_residuals();
    Block by_camera = DerivativesBy(jacobians, 0, rows, parameter_block_sizes()[0]);
    Block by_head = DerivativesBy(jacobians, 1, rows, 7);
    Block by_angles = DerivativesBy(jacobians, 2, rows, parameter_block_sizes()[2]);
    Block by_jitter = DerivativesBy(jacobians, 3, rows, 1);
    Block by_pose = DerivativesBy(jacobians, 4, rows, 7);
    Block by_mount = DerivativesBy(corners_.on_b ? jacobians : nullptr, 5, rows, 7);
    for (std::size_t i = 0; i < corners_.pixels.size(); ++i) {
      const Vector3d& on_board = corners_.on_board[i];
      const Vector3d on_a = a_from_b * on_board;
      const Vector3d in_base = pose * on_a;
      const Vector3d in_head = turn * in_base;
      CameraModel::ByPoint by_point;
      CameraModel::ByParameters by_parameters;
      const auto pixel = camera.Project(head * in_head, &by_point, &by_parameters);
      if (!pixel) return false;
      Eigen::Map<Eigen::Vector2d>(residuals + 2 * i) = weight_ * (*pixel - corners_.pixels[i]);
      if (jacobians == nullptr) continue;
      by_point *= weight_;
      const auto row = static_cast<Eigen::Index>(2 * i);
      if (by_camera.size() > 0) by_camera.middleRows<2>(row) = weight_ * by_parameters;
      if (by_head.size() > 0) by_head.block<2, 6>(row, 0) = by_point * ByStep(to_head, in_head);
      const Eigen::Vector2d by_angle = -by_point * (to_head * Vector3d::UnitX().cross(in_head));
      if (by_angles.size() > 0) by_angles.block<2, 1>(row, corners_.stop) = by_angle;
      if (by_jitter.size() > 0) by_jitter.block<2, 1>(row, 0) = by_angle;
      if (by_pose.size() > 0) by_pose.block<2, 6>(row, 0) = by_point * ByStep(to_a, on_a);
      if (by_mount.size() > 0) by_mount.block<2, 6>(row, 0) = by_point * ByStep(to_b, on_board);
    }
    return true;
  }

 private:
  CornerSet corners_;
  CameraModel camera_;
  double weight_;
};

class HitCost : public ceres::CostFunction {
 public:
  HitCost(const BoardHits& hits, std::shared_ptr<const AngleTable> angles, const MotorTrack* track,
          const HitCostOptions& options)
      : hits_(hits), angles_(std::move(angles)), track_(track), options_(options) {
    set_num_residuals(static_cast<int>(hits.returns.size()));
    auto& sizes = *mutable_parameter_block_sizes();
    sizes = {7, 1, 7, angles_->size(), 1, 7};
    if (hits.on_b) sizes.push_back(7);
  }

  bool Evaluate(const double* const* blocks, double* residuals, double** jacobians) const override {
    const auto lidar = PoseOf<frame::Camera, frame::Lidar>(blocks[0]);
    const auto head = PoseOf<frame::Camera, frame::Head>(blocks[2]);
    const auto pose = PoseOf<frame::Base, frame::Pattern>(blocks[5]);
    const auto a_from_b = hits_.on_b ? PoseOf<frame::Pattern, frame::Pattern>(blocks[6])
                                     : Rigid<frame::Pattern, frame::Pattern>();
    const auto head_from_lidar = head.Inverse() * lidar;
    const auto board_from_base = a_from_b.Inverse() * pose.Inverse();
    const Matrix3d lidar_rotation = lidar.RotationMatrix();
    const Matrix3d head_rotation = head.RotationMatrix();
    const Matrix3d pose_rotation = pose.RotationMatrix();
    const Matrix3d mount_rotation = a_from_b.RotationMatrix();

    const int rows = num_residuals();
    Block by_lidar = DerivativesBy(jacobians, 0, rows, 7);
    Block by_offset = DerivativesBy(jacobians, 1, rows, 1);
    Block by_head = DerivativesBy(jacobians, 2, rows, 7);
    Block by_angles = DerivativesBy(jacobians, 3, rows, angles_->size());
    Block by_own = DerivativesBy(jacobians, 4, rows, 1);
    Block by_pose = DerivativesBy(jacobians, 5, rows, 7);
    Block by_mount = DerivativesBy(hits_.on_b ? jacobians : nullptr, 6, rows, 7);

    for (int i = 0; i < rows; ++i) {
      const LidarReturn& r = hits_.returns[static_cast<std::size_t>(i)];
      residuals[i] = 0.0;
      const PlateAngle angle = AngleOf(r, blocks[3], blocks[4][0], by_angles.size() > 0);
      if (!std::isfinite(angle.rad)) continue;
      const auto base_from_head = HeadFromBase(angle.rad).Inverse();
      const Vector3d point = (r.range_m + blocks[1][0]) * r.direction;
      const auto board_from_lidar = board_from_base * base_from_head * head_from_lidar;
      const double along = board_from_lidar.Rotate(r.direction).z();
      const bool by_range = options_.residual == LidarResidual::kRange;
      if (by_range && std::abs(along) < kLeastSine) continue;
      const double depth = (board_from_lidar * point).z();
      const double scale = by_range ? along : 1.0;
      const double error = depth / scale;
      const Robust robust = Robustify(error / r.sigma_m);
      residuals[i] = robust.value;
      if (jacobians == nullptr) continue;

      // The residual's derivative is that of the depth of the point where the beam meets the plane:
      // the denominator's derivative is in it.
      const Vector3d in_lidar = by_range ? Vector3d(point - error * r.direction) : point;
      const Vector3d in_camera = lidar * in_lidar;
      const Vector3d in_head = head.Inverse() * in_camera;
      const Vector3d in_base = base_from_head * in_head;
      const Vector3d on_a = pose.Inverse() * in_base;
      const Vector3d on_board = a_from_b.Inverse() * on_a;
      const double weight = robust.slope / (r.sigma_m * scale);
      const RowVector3d n_board = weight * RowVector3d::UnitZ();
      const RowVector3d n_a = n_board * mount_rotation.transpose();
      const RowVector3d n_base = n_a * pose_rotation.transpose();
      const RowVector3d n_head = n_base * base_from_head.RotationMatrix();
      const RowVector3d n_camera = n_head * head_rotation.transpose();
      if (by_lidar.size() > 0)
        by_lidar.block<1, 6>(i, 0) = n_camera * ByStep(lidar_rotation, in_lidar);
      if (by_offset.size() > 0) by_offset(i, 0) = n_camera * lidar_rotation * r.direction;
      if (by_head.size() > 0) by_head.block<1, 6>(i, 0) = -ByInverseStep(n_head, in_head);
      if (by_pose.size() > 0) by_pose.block<1, 6>(i, 0) = -ByInverseStep(n_a, on_a);
      if (by_mount.size() > 0) by_mount.block<1, 6>(i, 0) = -ByInverseStep(n_board, on_board);
      const double by_angle = n_base * Vector3d::UnitX().cross(in_base);
      if (by_angles.size() > 0)
        for (int stop = 0; stop < angles_->size(); ++stop)
          by_angles(i, stop) = by_angle * angle.by_stop[static_cast<std::size_t>(stop)];
      if (by_own.size() > 0) by_own(i, 0) = by_angle * angle.by_own;
    }
    return true;
  }

 private:
  static constexpr double kLeastSine = 0.02;  ///< a beam along the board measures nothing

  struct PlateAngle {
    double rad = 0.0;
    double by_own = 0.0;  ///< by jitter, or by the stamp's offset
    std::vector<double> by_stop;
  };
  struct Robust {
    double value = 0.0;
    double slope = 1.0;
  };

  /// n . d(point) / d(step) of a pose whose inverse moves the point, with the sign turned.
  static Eigen::Matrix<double, 1, 6> ByInverseStep(const RowVector3d& n, const Vector3d& after) {
    Eigen::Matrix<double, 1, 6> by_step;
    by_step << -n * Skew(after), n;
    return by_step;
  }

  PlateAngle AngleOf(const LidarReturn& r, const double* plate_rad, double own,
                     bool want_by_stop) const {
    PlateAngle angle;
    if (want_by_stop) angle.by_stop.assign(static_cast<std::size_t>(angles_->size()), 0.0);
    if (hits_.stop != BoardHits::kNone) {
      angle.rad = plate_rad[hits_.stop] + own;
      angle.by_own = 1.0;
      if (want_by_stop) angle.by_stop[static_cast<std::size_t>(hits_.stop)] = 1.0;
      return angle;
    }
    const auto plate_at = [&](double time_s, double* by_stop) {
      return angles_->PlateAngle(track_->AngleAt(time_s), plate_rad, by_stop);
    };
    constexpr double kStep_s = 0.004;
    const double time_s = r.time_s + own;
    angle.rad = plate_at(time_s, want_by_stop ? angle.by_stop.data() : nullptr);
    angle.by_own =
        (plate_at(time_s + kStep_s, nullptr) - plate_at(time_s - kStep_s, nullptr)) / (2 * kStep_s);
    if (!std::isfinite(angle.by_own)) angle.rad = angle.by_own;
    return angle;
  }

  /// Its square is twice Huber's cost.
  Robust Robustify(double value) const {
    const double limit = options_.huber_sigmas, size = std::abs(value);
    if (limit <= 0.0 || size <= limit) return {value, 1.0};
    const double root = std::sqrt(2.0 * limit * size - limit * limit);
    return {std::copysign(root, value), limit / root};
  }

  BoardHits hits_;
  std::shared_ptr<const AngleTable> angles_;
  const MotorTrack* track_;
  HitCostOptions options_;
};

class PriorCost : public ceres::CostFunction {
 public:
  explicit PriorCost(double sigma) : weight_(1.0 / sigma) {
    set_num_residuals(1);
    *mutable_parameter_block_sizes() = {1};
  }

  bool Evaluate(const double* const* blocks, double* residuals, double** jacobians) const override {
    residuals[0] = weight_ * blocks[0][0];
    if (jacobians != nullptr && jacobians[0] != nullptr) jacobians[0][0] = weight_;
    return true;
  }

 private:
  double weight_;
};

}  // namespace

AngleTable::AngleTable(std::vector<double> motor_rad) : motor_rad_(std::move(motor_rad)) {
  for (std::size_t stop = 0; stop < motor_rad_.size(); ++stop) {
    std::vector<AngleCorrection::Knot> knots;
    for (std::size_t i = 0; i < motor_rad_.size(); ++i)
      knots.push_back({motor_rad_[i], motor_rad_[i] + (i == stop ? 1.0 : 0.0)});
    auto basis = AngleCorrection::FromKnots(std::move(knots));
    FORESIGHT_EXPECTS(basis.has_value(), "stops increase");
    basis_.push_back(*basis);
  }
}

double AngleTable::PlateAngle(double motor_rad, const double* plate_rad, double* by_stop) const {
  double plate = motor_rad;
  for (std::size_t stop = 0; stop < basis_.size(); ++stop) {
    const double weight = basis_[stop].PlateAngle(motor_rad) - motor_rad;
    plate += weight * (plate_rad[stop] - motor_rad_[stop]);
    if (by_stop != nullptr) by_stop[stop] = weight;
  }
  return plate;
}

std::unique_ptr<ceres::CostFunction> MakeViewCost(const CornerSet& corners,
                                                  const CameraModel& camera, double sigma_px) {
  return std::make_unique<ViewCost>(corners, camera, sigma_px);
}

std::unique_ptr<ceres::CostFunction> MakeMountCost(const CornerSet& corners,
                                                   const CameraModel& camera, int stops,
                                                   double sigma_px) {
  return std::make_unique<MountCost>(corners, camera, stops, sigma_px);
}

std::unique_ptr<ceres::CostFunction> MakeHitCost(const BoardHits& hits,
                                                 std::shared_ptr<const AngleTable> angles,
                                                 const MotorTrack* track,
                                                 const HitCostOptions& options) {
  return std::make_unique<HitCost>(hits, std::move(angles), track, options);
}

std::unique_ptr<ceres::CostFunction> MakePriorCost(double sigma) {
  return std::make_unique<PriorCost>(sigma);
}

}  // namespace foresight::chain
