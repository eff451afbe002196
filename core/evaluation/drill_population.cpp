#include "core/evaluation/drill_population.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/evaluation/drill_scene.h"
#include "core/evaluation/sigma_errors.h"
#include "core/fitting/drill/drill_verdict.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

constexpr double kPlaceOk_mm = 30.0;
constexpr double kYawOk_deg = 20.0;
constexpr double kPlaceAllOk_mm = 25.0;
constexpr double kYawAllOk_deg = 15.0;
constexpr double kAxisAllOk_deg = 10.0;
constexpr double kFlipped_deg = 90.0;

struct DrillErrors {
  double xy_mm = 0.0;
  double yaw_deg = 0.0;
  double axis_deg = 0.0;
  double lean_rad = 0.0;  ///< forward, found minus true
};

/// The found body's axis against the true grip's, in the truth's frame.
DrillErrors Compare(const DrillCandidate& found,
                    const Rigid<frame::Base, frame::Object>& base_from_truth,
                    const DrillTruth& truth) {
  const auto truth_from_found = base_from_truth.Inverse() * found.base_from_object;
  const Eigen::Quaterniond true_turn = BodyTurn(truth.body_tilt_rad);
  const Eigen::Vector3d true_axis = true_turn * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d middle = truth.grip_height_m * true_axis;
  const Eigen::Vector3d axis =
      truth_from_found.Rotate(BodyTurn(found.model.body_tilt_rad) * Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d from_origin = middle - truth_from_found.translation();
  const Eigen::Vector3d x = truth_from_found.Rotate(Eigen::Vector3d::UnitX());
  DrillErrors errors;
  errors.xy_mm = 1000.0 * (from_origin - from_origin.dot(axis) * axis).norm();
  errors.yaw_deg = DegreesFromRadians(std::abs(std::atan2(x.y(), x.x())));
  errors.lean_rad = axis.x() - true_axis.x();
  errors.axis_deg = DegreesFromRadians(std::acos(std::clamp(axis.dot(true_axis), -1.0, 1.0)));
  return errors;
}

}  // namespace

FitTrialScene DrillPopulation::MakeScene(std::uint64_t seed) const {
  return RandomDrillScene(seed);
}

std::vector<FitOutcome> DrillPopulation::Judge(const FitTrial& trial,
                                               const Result<Detection>& found) const {
  FitOutcome outcome;
  if (!found) {
    outcome.reason = found.error().message;
    return {outcome};
  }
  const auto& detection = std::get<DrillDetection>(*found);
  outcome.found = true;
  outcome.verdict = detection.verdict;
  outcome.reason = detection.verdict.reason;
  if (trial.scene.scene->drills.empty()) return {outcome};
  const DrillTruth& truth = trial.scene.scene->drills.front();
  const DrillErrors errors =
      Compare(detection.best, trial.TrueBaseFromRobot() * truth.robot_from_object, truth);
  outcome.errors = {{"xy_mm", errors.xy_mm},
                    {"yaw_deg", errors.yaw_deg},
                    {"axis_deg", errors.axis_deg},
                    {"flip", errors.yaw_deg > kFlipped_deg ? 1.0 : 0.0}};
  AddSigmaErrors(detection.best.base_from_object.Inverse() *
                     (trial.TrueBaseFromRobot() * truth.robot_from_object),
                 detection.covariance, 2.0 * std::numbers::pi, outcome.errors);
  outcome.errors.emplace_back(std::string("lean") + kSigmaErrorSuffix,
                              errors.lean_rad / detection.sigma_axis_rad);
  outcome.pose_ok = errors.xy_mm < kPlaceOk_mm && errors.yaw_deg < kYawOk_deg;
  outcome.all_ok = errors.xy_mm < kPlaceAllOk_mm && errors.yaw_deg < kYawAllOk_deg &&
                   errors.axis_deg < kAxisAllOk_deg;
  return {outcome};
}

std::vector<std::string> DrillPopulation::FeatureNames() const {
  return DrillFeatureNames();
}

}  // namespace foresight
