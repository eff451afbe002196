#include "core/evaluation/valve_population.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/evaluation/sigma_errors.h"
#include "core/evaluation/valve_scene.h"
#include "core/fitting/valve/valve_evidence.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

constexpr double kRadiusOk_mm = 12.0;
constexpr double kLengthOk_mm = 20.0;
constexpr double kPhaseOk_deg = 6.0;

struct ValveErrors {
  double center_mm = 0.0;
  double along_mm = 0.0;  ///< of it along the axis
  double axis_deg = 0.0;
  double radius_mm = 0.0;
  double phase_deg = 0.0;
  bool spokes_right = false;
};

/// Angle of x about z, modulo what the valve's symmetry leaves open.
double PhaseError(const Rigid<frame::Object, frame::Object>& truth_from_found,
                  const ValveModel& truth) {
  if (!truth.IsLever() && truth.spokes == 0) return 0.0;
  const Eigen::Vector3d x = truth_from_found.Rotate(Eigen::Vector3d::UnitX());
  const double sector = 2.0 * std::numbers::pi / (truth.IsLever() ? 1 : truth.spokes);
  return std::abs(std::remainder(std::atan2(x.y(), x.x()), sector));
}

ValveErrors Compare(const ValveCandidate& found,
                    const Rigid<frame::Base, frame::Object>& base_from_truth,
                    const ValveModel& truth) {
  const Rigid<frame::Object, frame::Object> truth_from_found =
      base_from_truth.Inverse() * found.base_from_object;
  const double cosine = truth_from_found.Rotate(Eigen::Vector3d::UnitZ()).z();
  const double size_m = truth.IsLever() ? found.model.lever_length_m - truth.lever_length_m
                                        : found.model.rim_radius_m - truth.rim_radius_m;
  ValveErrors errors;
  errors.center_mm = 1000.0 * truth_from_found.translation().norm();
  errors.along_mm = 1000.0 * truth_from_found.translation().z();
  errors.axis_deg = DegreesFromRadians(std::acos(std::clamp(cosine, -1.0, 1.0)));
  errors.radius_mm = 1000.0 * std::abs(size_m);
  errors.phase_deg = DegreesFromRadians(PhaseError(truth_from_found, truth));
  errors.spokes_right =
      found.model.kind == truth.kind && (truth.IsLever() || found.model.spokes == truth.spokes);
  return errors;
}

}  // namespace

FitTrialScene ValvePopulation::MakeScene(std::uint64_t seed) const {
  return RandomValveScene(seed);
}

std::vector<FitOutcome> ValvePopulation::Judge(const FitTrial& trial,
                                               const Result<Detection>& found) const {
  FitOutcome outcome;
  if (!found) {
    outcome.reason = found.error().message;
    return {outcome};
  }
  const auto& detection = std::get<ValveDetection>(*found);
  outcome.found = true;
  outcome.verdict = detection.verdict;
  outcome.reason = detection.verdict.reason;
  if (trial.scene.scene->valves.empty()) return {outcome};
  const ValveTruth& truth = trial.scene.scene->valves.front();
  const ValveErrors errors =
      Compare(detection.best, trial.TrueBaseFromRobot() * truth.robot_from_object, truth.model);
  outcome.errors = {{"center_mm", errors.center_mm}, {"along_mm", errors.along_mm},
                    {"axis_deg", errors.axis_deg},   {"radius_mm", errors.radius_mm},
                    {"phase_deg", errors.phase_deg}, {"spokes", errors.spokes_right ? 0.0 : 1.0}};
  if (!truth.model.IsLever()) {
    const ValveModel& model = detection.best.model;
    outcome.errors.emplace_back("rim_width_mm",
                                1000.0 * (model.tube_radius_m - truth.model.tube_radius_m));
    outcome.errors.emplace_back("rim_depth_mm",
                                1000.0 * (model.RimDepth() - truth.model.RimDepth()));
    outcome.errors.emplace_back("brightness", detection.best.brightness);
  }
  const bool round = truth.model.IsLever() || truth.model.spokes == 0;
  AddSigmaErrors(detection.best.base_from_object.Inverse() *
                     (trial.TrueBaseFromRobot() * truth.robot_from_object),
                 detection.covariance, 2.0 * std::numbers::pi / (round ? 1 : truth.model.spokes),
                 outcome.errors);
  const double size_ok_mm = truth.model.IsLever() ? kLengthOk_mm : kRadiusOk_mm;
  outcome.pose_ok =
      detection.best.model.kind == truth.model.kind && errors.center_mm < 1000.0 * kRightPlace_m &&
      errors.axis_deg < DegreesFromRadians(kRightAxis_rad) && errors.radius_mm < size_ok_mm;
  outcome.all_ok = outcome.pose_ok && errors.spokes_right && errors.phase_deg < kPhaseOk_deg;
  return {outcome};
}

std::vector<std::string> ValvePopulation::FeatureNames() const {
  return ValveFeatureNames();
}

}  // namespace foresight
