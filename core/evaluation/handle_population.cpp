#include "core/evaluation/handle_population.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/evaluation/handle_scene.h"
#include "core/evaluation/sigma_errors.h"
#include "core/fitting/handle/handle_verdict.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

constexpr double kPivotOk_mm = 20.0;
constexpr double kDirectionOk_deg = 10.0;
constexpr double kNormalOk_deg = 5.0;
constexpr double kPivotAllOk_mm = 15.0;
constexpr double kDirectionAllOk_deg = 8.0;
constexpr double kLengthAllOk_mm = 20.0;
constexpr double kHandleFlipped_deg = 90.0;

struct HandleErrors {
  double pivot_mm = 0.0;
  Eigen::Vector3d place_mm;  ///< found less true, along the axes of the truth
  double direction_deg = 0.0;
  double normal_deg = 0.0;
  double length_mm = 0.0;  ///< found less true
};

double Angle_deg(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return DegreesFromRadians(std::acos(std::clamp(a.dot(b), -1.0, 1.0)));
}

HandleErrors Compare(const HandleCandidate& found,
                     const Rigid<frame::Base, frame::Object>& base_from_truth,
                     const HandleModel& truth) {
  const auto truth_from_found = base_from_truth.Inverse() * found.base_from_object;
  const auto axis = [&](const Eigen::Vector3d& unit) {
    return Angle_deg(truth_from_found.Rotate(unit), unit);
  };
  return {1000.0 * truth_from_found.translation().norm(), 1000.0 * truth_from_found.translation(),
          axis(Eigen::Vector3d::UnitX()), axis(Eigen::Vector3d::UnitZ()),
          1000.0 * (found.model.length_m - truth.length_m)};
}

}  // namespace

FitTrialScene HandlePopulation::MakeScene(std::uint64_t seed) const {
  return RandomHandleScene(seed);
}

std::vector<FitOutcome> HandlePopulation::Judge(const FitTrial& trial,
                                                const Result<Detection>& found) const {
  FitOutcome outcome;
  if (!found) {
    outcome.reason = found.error().message;
    return {outcome};
  }
  const auto& detection = std::get<HandleDetection>(*found);
  outcome.found = true;
  outcome.verdict = detection.verdict;
  outcome.reason = detection.verdict.reason;
  if (!trial.scene.positive) return {outcome};
  const HandleTruth& truth = trial.scene.scene->handles.front();
  const auto base_from_truth = trial.TrueBaseFromRobot() * truth.robot_from_object;
  const HandleErrors errors = Compare(detection.best, base_from_truth, truth.model);
  outcome.errors = {{"pivot_mm", errors.pivot_mm},
                    {"along_mm", errors.place_mm.x()},
                    {"across_mm", errors.place_mm.y()},
                    {"out_mm", errors.place_mm.z()},
                    {"direction_deg", errors.direction_deg},
                    {"normal_deg", errors.normal_deg},
                    {"length_mm", std::abs(errors.length_mm)},
                    {"flip", errors.direction_deg > kHandleFlipped_deg ? 1.0 : 0.0}};
  AddSigmaErrors(detection.best.base_from_object.Inverse() * base_from_truth, detection.covariance,
                 2.0 * std::numbers::pi, outcome.errors);
  if (detection.sigma_length_m > 0.0)
    outcome.errors.emplace_back(std::string("length") + kSigmaErrorSuffix,
                                -0.001 * errors.length_mm / detection.sigma_length_m);
  outcome.pose_ok = errors.pivot_mm < kPivotOk_mm && errors.direction_deg < kDirectionOk_deg &&
                    errors.normal_deg < kNormalOk_deg;
  outcome.all_ok = outcome.pose_ok && errors.pivot_mm < kPivotAllOk_mm &&
                   errors.direction_deg < kDirectionAllOk_deg &&
                   std::abs(errors.length_mm) < kLengthAllOk_mm;
  return {outcome};
}

std::vector<std::string> HandlePopulation::FeatureNames() const {
  return HandleFeatureNames();
}

}  // namespace foresight
