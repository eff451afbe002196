#include "core/fitting/drill/drill_covariance.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/squared.h"
#include "core/fitting/beam_model.h"
#include "core/fitting/drill/drill_slopes.h"
#include "core/fitting/line_covariance.h"
#include "core/fitting/ray_selection.h"

namespace foresight {
namespace {

// What no ray tells, that drills are no templates and tables no planes, along and about x, y and z:
// the deviations of the rays are multiplied, and what every drill is off by is added in squares.
// Chosen so that the spreads over predicted that packaging/refit-verdicts prints of its training
// scenes are near 1 (docs/evaluation/drill.md, "What a drill stands on"); with factors of 1 and
// nothing added they were 1.4 to 3.2 before a drill had proportions of its own.
constexpr std::array<double, 6> kFactors = {1.15, 1.3, 1.0, 1.0, 1.0, 1.4};
constexpr std::array<double, 6> kAdded = {0.0045, 0.0022, 0.0015, 0.0, 0.0, 0.010};

/// Covariance of the table's turns about the object's x and y, from the rays that end on it round
/// the object, also beyond the region where they are known.
Eigen::Matrix2d TableTiltCovariance(const RaySet& region, const Plane& table,
                                    const Rigid<frame::Base, frame::Object>& base_from_object) {
  constexpr double kMadeOf_rad = 0.0035;  // tables and rigs are not level to better than this
  constexpr double kBefore_rad = 0.05;    // without a ray
  constexpr double kRound_m = 0.4;
  const RaySet* around = SurroundingBeams(region);
  const RaySet& rays = around != nullptr ? *around : region;
  const auto object_from_base = base_from_object.Inverse();
  std::vector<RangeRay> on_table;
  std::vector<Eigen::Vector4d> rows;  // 1, x, y, error; all over its deviation
  for (const RangeRay& ray : rays.rays) {
    const double sigma = rays.sigma_m * std::abs(table.normal.dot(ray.direction)) + 0.001;
    const double error = table.Distance(ray.Point());
    if (std::abs(error) > BeamModel::kAgreeSigmas * sigma) continue;
    const Eigen::Vector3d at = object_from_base * ray.Point();
    if (at.head<2>().norm() > kRound_m) continue;
    on_table.push_back(ray);
    rows.emplace_back(Eigen::Vector4d(1.0, at.x(), at.y(), error) / sigma);
  }
  Eigen::MatrixXd design(std::ssize(rows), 3), scores(std::ssize(rows), 3);
  for (Eigen::Index i = 0; i < design.rows(); ++i) {
    const Eigen::Vector4d& row = rows[static_cast<std::size_t>(i)];
    design.row(i) = row.head<3>().transpose();
    scores.row(i) = row[3] * row.head<3>().transpose();
  }
  const double weight = rays.Worth();
  const Eigen::Matrix3d prior =
      Eigen::Vector3d(1.0, 1.0 / Squared(kBefore_rad), 1.0 / Squared(kBefore_rad)).asDiagonal();
  const Eigen::Matrix3d information = weight * design.transpose() * design + prior;
  const Eigen::MatrixXd covariance =
      CovarianceClusteredByLine(on_table, weight * scores, information, prior);
  // z = a x + b y: a turn of b about x and of -a about y.
  Eigen::Matrix<double, 2, 3> turns;
  turns << 0.0, 0.0, 1.0, 0.0, -1.0, 0.0;
  return turns * covariance * turns.transpose() +
         Squared(kMadeOf_rad) * Eigen::Matrix2d::Identity();
}

// By how much a grip leans forward of the fitted one, beside what the rays know: no grip is a
// straight cylinder. Without it the spread over predicted of the lean was 1.7 to 2.4, before a grip
// could lean by itself (`evaluate-fits drill --first-seed 1 --count 200 --source raw,foresight`,
// and
// --world varied from 5001 on).
constexpr double kGripError_rad = 0.036;

}  // namespace

double SetSigmas(const RaySet& rays, const DrillState& drill, const TableFrame& base_from_table,
                 const DrillPrior& prior, DrillDetection& detection) {
  constexpr double kUnknownTableTilt_rad = 0.03;
  const DrillSlopes slopes = SlopesOf(rays, drill, base_from_table, prior);
  const DrillInformation of_beams = slopes.information.ldlt().solve(DrillInformation::Identity());
  const DrillInformation of_prior = prior.Information().asDiagonal();
  const DrillInformation covariance =
      CovarianceClusteredByLine(rays.rays, slopes.scores, slopes.information, of_prior);
  // From the table's frame to the object's own axes.
  Eigen::Matrix<double, 6, kDrillParameters> to_pose =
      Eigen::Matrix<double, 6, kDrillParameters>::Zero();
  const Eigen::AngleAxisd turn(-drill.yaw(), Eigen::Vector3d::UnitZ());
  to_pose.topLeftCorner<3, 3>() = turn.toRotationMatrix();
  to_pose(5, kDrillYaw) = 1.0;
  detection.covariance = to_pose * covariance * to_pose.transpose();
  detection.covariance.block<2, 2>(3, 3) +=
      detection.table
          ? TableTiltCovariance(rays, *detection.table, detection.best.base_from_object)
          : Eigen::Matrix2d(Squared(kUnknownTableTilt_rad) * Eigen::Matrix2d::Identity());
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  const Eigen::Map<const Vector6> factors(kFactors.data()), added(kAdded.data());
  detection.covariance =
      (factors.asDiagonal() * detection.covariance * factors.asDiagonal()).eval();
  detection.covariance.diagonal() += added.cwiseAbs2();
  const Vector6 sigmas = detection.covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  detection.sigma_position_m = sigmas.head<3>();
  detection.sigma_yaw_rad = sigmas[5];
  const double sideways = covariance(kDrillTiltX, kDrillTiltX);
  const double forward = covariance(kDrillTiltY, kDrillTiltY) +
                         2.0 * covariance(kDrillTiltY, kDrillRake) +
                         covariance(kDrillRake, kDrillRake);
  const auto root = [](double variance) { return std::sqrt(std::max(0.0, variance)); };
  detection.sigma_axis_rad = std::max(std::hypot(root(sideways), sigmas[3]),
                                      std::hypot(root(forward), sigmas[4], kGripError_rad));
  return std::sqrt(std::max(0.0, of_beams(kDrillYaw, kDrillYaw)));
}

}  // namespace foresight
