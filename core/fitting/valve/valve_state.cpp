#include "core/fitting/valve/valve_state.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace foresight {
namespace {

constexpr double kSpokePerTube = 0.67;
constexpr double kHubPerRim = 0.20;
constexpr double kLeverHubPerTube = 2.0;

double Squared(double value) {
  return value * value;
}

}  // namespace

ValveModel UsualValve(double rim_radius_m, double tube_radius_m, int spokes, double dish_m) {
  ValveModel model;
  model.rim_radius_m = std::clamp(rim_radius_m, 0.030, 0.400);
  model.tube_radius_m = std::clamp(tube_radius_m, 0.005, 0.025);
  model.spokes = spokes;
  model.dish_m = std::clamp(dish_m, -0.060, 0.120);
  model.spoke_radius_m = kSpokePerTube * model.tube_radius_m;
  model.hub_radius_m = kHubPerRim * model.rim_radius_m;
  return model;
}

ValveModel UsualLever(double length_m, double tube_radius_m) {
  ValveModel model;
  model.kind = ValveModel::Kind::kLever;
  model.lever_length_m = std::clamp(length_m, 0.060, 0.450);
  model.tube_radius_m = std::clamp(tube_radius_m, 0.005, 0.025);
  model.hub_radius_m = kLeverHubPerTube * model.tube_radius_m;
  model.spokes = 0;
  return model;
}

ValveCandidate Moved(const ValveCandidate& valve, const ValveStep& step) {
  const Eigen::Quaterniond& rotation = valve.base_from_object.rotation();
  const Eigen::Vector3d turn = step.segment<3>(kTiltX);
  const double angle = turn.norm();
  const Eigen::Quaterniond turned =
      angle > 0.0 ? rotation * Eigen::Quaterniond(Eigen::AngleAxisd(angle, turn / angle))
                  : rotation;
  const ValveModel& model = valve.model;
  const double tube_radius_m = model.tube_radius_m + step[kTubeRadius];
  return {Rigid<frame::Base, frame::Object>(
              turned, valve.base_from_object.translation() + rotation * step.segment<3>(kMoveX)),
          model.IsLever() ? UsualLever(model.lever_length_m + step[kRimRadius], tube_radius_m)
                          : UsualValve(model.rim_radius_m + step[kRimRadius], tube_radius_m,
                                       model.spokes, model.dish_m + step[kDish]),
          valve.log_likelihood,
          std::clamp(valve.brightness * std::exp(step[kBrightness]), 0.1, 10.0)};
}

double LeverTilt(const ValveCandidate& valve, const std::optional<Plane>& wall) {
  if (!wall || !valve.model.IsLever()) return 0.0;
  return valve.base_from_object.Rotate(Eigen::Vector3d::UnitY()).dot(wall->normal);
}

double LogPrior(const ValveCandidate& valve, const std::optional<Plane>& wall) {
  const ValveModel& model = valve.model;
  const double tube =
      (model.tube_radius_m - ValvePrior::kTubeRadius_m) / ValvePrior::kTubeRadiusSigma_m;
  const double common =
      Squared(tube) + Squared(std::log(valve.brightness) / ValvePrior::kBrightnessSigma);
  const double own = model.IsLever()
                         ? Squared(LeverTilt(valve, wall) / ValvePrior::kLeverTiltSigma_rad)
                         : Squared((model.dish_m - ValvePrior::kDish_m) / ValvePrior::kDishSigma_m);
  return -0.5 * (common + own);
}

ValveCandidate WithUpwardSpoke(const ValveCandidate& valve) {
  if (valve.model.IsLever()) return valve;
  const auto& pose = valve.base_from_object;
  const Eigen::Vector3d up = pose.rotation().conjugate() * Eigen::Vector3d(0.0, -1.0, 0.0);
  double turn = std::atan2(up.y(), up.x());
  if (valve.model.spokes > 0) {
    const double sector = 2.0 * std::numbers::pi / valve.model.spokes;
    turn = sector * std::round(turn / sector);
  }
  ValveCandidate turned = valve;
  turned.base_from_object = Rigid<frame::Base, frame::Object>(
      pose.rotation() * Eigen::Quaterniond(Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ())),
      pose.translation());
  return turned;
}

Rigid<frame::Base, frame::Object> PoseFromAxis(const Eigen::Vector3d& center,
                                               const Eigen::Vector3d& axis) {
  Eigen::Vector3d x = Eigen::Vector3d(0.0, -1.0, 0.0) + axis.y() * axis;
  x = x.norm() > 1e-3 ? x.normalized() : axis.unitOrthogonal();
  Eigen::Matrix3d rotation;
  rotation << x, axis.cross(x), axis;
  return {rotation, center};
}

}  // namespace foresight
