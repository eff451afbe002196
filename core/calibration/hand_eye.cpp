#include "core/calibration/hand_eye.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "core/calibration/tangent.h"
#include "core/geometry/angles.h"
#include "core/geometry/nearest_rotation.h"
#include "core/geometry/symmetric_eigen.h"

namespace foresight {
namespace {

using RobotFromBase = Rigid<frame::Robot, frame::Base>;
using HandFromBoard = Rigid<frame::Hand, frame::Pattern>;

/// Two samples: the hand's motion in robot and the board's in base.
struct Motion {
  Rigid<frame::Robot, frame::Robot> in_robot;
  Rigid<frame::Base, frame::Base> in_base;
};

std::vector<Motion> MotionsOf(const std::vector<HandEyeSample>& samples) {
  std::vector<Motion> motions;
  for (std::size_t i = 0; i < samples.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      motions.push_back({samples[i].robot_from_hand * samples[j].robot_from_hand.Inverse(),
                         samples[i].base_from_board * samples[j].base_from_board.Inverse()});
  return motions;
}

/// How the axes of motions spread, by the second moments of their rotation vectors.
struct Richness {
  double turn_rad = 0.0;
  double spread = 0.0;
  Eigen::Vector3d main_axis;  ///< in robot
};

Richness RichnessOf(const std::vector<Motion>& motions) {
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const Motion& motion : motions) {
    const Eigen::Vector3d turn = RotationLog(motion.in_robot.rotation());
    moments += turn * turn.transpose() / static_cast<double>(motions.size());
  }
  const auto [values, axes] = EigenOf(moments);
  return {std::sqrt(std::max(0.0, values.sum())),
          std::sqrt(std::max(0.0, values[1]) / std::max(values[2], 1e-12)), axes.col(2)};
}

Status CheckRichness(const Richness& richness, const HandEyeOptions& options) {
  if (richness.turn_rad < options.least_turn_rad)
    return Fail(ErrorCode::kTooFewPoints,
                "robot frame: the hand turned by {:.1f} deg (rms) between the samples, {:.0f} deg "
                "are needed. Turn it by 30 deg and more, about different axes",
                DegreesFromRadians(richness.turn_rad), DegreesFromRadians(options.least_turn_rad));
  if (richness.spread >= options.least_spread) return {};
  const Eigen::Vector3d& a = richness.main_axis;
  return Fail(
      ErrorCode::kTooFewPoints,
      "robot frame: the hand turned about one axis only, ({:.2f}, {:.2f}, {:.2f}) in robot: "
      "the place of the head along it stays open. Turn the hand about another axis too",
      a.x(), a.y(), a.z());
}

/// AX = XB: rotation vectors in robot are those in base, turned; then the shift is linear.
RobotFromBase StartFromMotions(const std::vector<Motion>& motions) {
  Eigen::Matrix3d correlation = Eigen::Matrix3d::Zero();
  for (const Motion& motion : motions)
    correlation += RotationLog(motion.in_robot.rotation()) *
                   RotationLog(motion.in_base.rotation()).transpose();
  const Eigen::Matrix3d rotation = NearestRotation(correlation);
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const Motion& motion : motions) {
    const Eigen::Matrix3d row = motion.in_robot.RotationMatrix() - Eigen::Matrix3d::Identity();
    normal += row.transpose() * row;
    right +=
        row.transpose() * (rotation * motion.in_base.translation() - motion.in_robot.translation());
  }
  return {rotation, Eigen::Vector3d(normal.ldlt().solve(right))};
}

/// Weighted residuals of all samples, 6 each.
Eigen::VectorXd ResidualsOf(const std::vector<HandEyeSample>& samples, const RobotFromBase& base,
                            const HandFromBoard& board, const HandEyeOptions& options) {
  Eigen::VectorXd residuals(static_cast<Eigen::Index>(6 * samples.size()));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto step =
        StepBetween(samples[i].robot_from_hand * board, base * samples[i].base_from_board);
    const auto row = static_cast<Eigen::Index>(6 * i);
    residuals.segment<3>(row) = step.head<3>() / options.sigma_turn_rad;
    residuals.segment<3>(row + 3) = step.tail<3>() / options.sigma_shift_m;
  }
  return residuals;
}

/// Gauss-Newton over the base's pose and, where `free_board`, the board's on the hand.
HandEyeCalibration Refine(const std::vector<HandEyeSample>& samples, RobotFromBase base,
                          HandFromBoard board, bool free_board, const HandEyeOptions& options) {
  const int unknowns = free_board ? 12 : 6;
  using Step = Eigen::Matrix<double, 6, 1>;
  const auto moved = [&](const Eigen::VectorXd& step) {
    const Step of_board = free_board ? Step(step.tail<6>()) : Step::Zero();
    return std::pair(Perturbed(base, Step(step.head<6>())), Perturbed(board, of_board));
  };
  Eigen::MatrixXd jacobian(static_cast<Eigen::Index>(6 * samples.size()), unknowns);
  Eigen::VectorXd residuals;
  for (int iteration = 0; iteration < 20; ++iteration) {
    residuals = ResidualsOf(samples, base, board, options);
    constexpr double kDelta = 1e-6;  // central differences: exact to 1e-9
    for (int i = 0; i < unknowns; ++i) {
      const Eigen::VectorXd delta = kDelta * Eigen::VectorXd::Unit(unknowns, i);
      const auto [base_up, board_up] = moved(delta);
      const auto [base_down, board_down] = moved(-delta);
      jacobian.col(i) = (ResidualsOf(samples, base_up, board_up, options) -
                         ResidualsOf(samples, base_down, board_down, options)) /
                        (2.0 * kDelta);
    }
    const Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
    const Eigen::VectorXd step = -normal.ldlt().solve(jacobian.transpose() * residuals);
    std::tie(base, board) = moved(step);
    if (step.norm() < 1e-10) break;
  }
  residuals = ResidualsOf(samples, base, board, options);
  const double freedom = static_cast<double>(residuals.size()) - unknowns;
  const double chi = freedom > 0.0 ? residuals.squaredNorm() / freedom : 1.0;
  const Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
  const Eigen::MatrixXd inverse =
      normal.ldlt().solve(Eigen::MatrixXd::Identity(unknowns, unknowns));
  HandEyeCalibration result;
  result.robot_from_base = base;
  result.hand_from_board = board;
  result.covariance = std::max(1.0, chi) * inverse.topLeftCorner<6, 6>();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(6 * i);
    const auto count = static_cast<double>(samples.size());
    result.turn_rms_rad += residuals.segment<3>(row).squaredNorm() / count;
    result.shift_rms_m += residuals.segment<3>(row + 3).squaredNorm() / count;
  }
  result.turn_rms_rad = options.sigma_turn_rad * std::sqrt(result.turn_rms_rad);
  result.shift_rms_m = options.sigma_shift_m * std::sqrt(result.shift_rms_m);
  return result;
}

}  // namespace

Status HandEyeOptions::Check() const {
  for (const auto& [name, value] :
       {std::pair<const char*, double>("sigma_turn_rad", sigma_turn_rad),
        {"sigma_shift_m", sigma_shift_m},
        {"least_spread", least_spread},
        {"least_turn_rad", least_turn_rad}})
    if (!(value > 0.0) || !std::isfinite(value))
      return Fail(ErrorCode::kInvalidOptions, "robot frame: {} {} is not positive", name, value);
  return {};
}

Result<HandEyeCalibration> CalibrateHandEye(const std::vector<HandEyeSample>& samples,
                                            const HandEyeOptions& options) {
  FORESIGHT_CHECK(options.Check());
  constexpr std::size_t kLeastSamples = 3;
  if (samples.size() < kLeastSamples)
    return Fail(ErrorCode::kTooFewPoints,
                "robot frame: {} samples of the board on the hand, at least {} are needed",
                samples.size(), kLeastSamples);
  const std::vector<Motion> motions = MotionsOf(samples);
  const Richness richness = RichnessOf(motions);
  FORESIGHT_CHECK(CheckRichness(richness, options));
  const RobotFromBase start = StartFromMotions(motions);
  const HandFromBoard board =
      samples.front().robot_from_hand.Inverse() * start * samples.front().base_from_board;
  HandEyeCalibration result = Refine(samples, start, board, true, options);
  result.spread = richness.spread;
  result.turn_rad = richness.turn_rad;
  return result;
}

Result<HandEyeCalibration> CalibrateSurveyed(const std::vector<SurveyedBoard>& boards,
                                             const HandEyeOptions& options) {
  FORESIGHT_CHECK(options.Check());
  if (boards.empty())
    return Fail(ErrorCode::kTooFewPoints, "robot frame: no surveyed board was seen");
  std::vector<HandEyeSample> samples;
  samples.reserve(boards.size());
  for (const SurveyedBoard& board : boards)
    samples.push_back({Rigid<frame::Robot, frame::Hand>(board.robot_from_board.rotation(),
                                                        board.robot_from_board.translation()),
                       board.base_from_board});
  const RobotFromBase start =
      boards.front().robot_from_board * boards.front().base_from_board.Inverse();
  return Refine(samples, start, {}, false, options);
}

}  // namespace foresight
