#include "core/fitting/valve/valve_state.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/squared.h"

namespace foresight {
namespace {

constexpr double kHubPerRim = 0.20;
constexpr double kSpokePerTube = 0.67;
constexpr double kLeastDepth_m = 0.002;  // half of it, of any section
constexpr double kMostDepth_m = 0.020;

/// By what a tilt against the wall's normal is multiplied to count as a residual of the prior.
double SquareWeight(double tilt2) {
  const double square2 = Squared(ValvePrior::kSquareSigma_rad);
  const double skew2 = Squared(ValvePrior::kSkewSigma_rad);
  if (tilt2 < 1e-12) return 1.0 / ValvePrior::kSquareSigma_rad;
  const double square = ValvePrior::kSquareFraction / square2;
  const double skew = (1.0 - ValvePrior::kSquareFraction) / skew2;
  const double density =
      square * std::exp(-0.5 * tilt2 / square2) + skew * std::exp(-0.5 * tilt2 / skew2);
  return std::sqrt(-2.0 * std::log(density / (square + skew)) / tilt2);
}

ValveModel StepWheel(const ValveModel& model, const ValveStep& step) {
  ValveModel stepped =
      UsualValve(model.rim_radius_m + step[kRimRadius], model.tube_radius_m + step[kTubeRadius],
                 model.spokes, model.dish_m + step[kDish]);
  const auto ratio = [](double depth_m, double width_m) {
    return std::clamp(depth_m, kLeastDepth_m, kMostDepth_m) / width_m;
  };
  stepped.rim_depth_ratio = ratio(model.RimDepth() + step[kRimDepth], stepped.tube_radius_m);
  if (model.spokes == 0) return stepped;
  stepped.spoke_radius_m = std::clamp(model.spoke_radius_m + step[kSpokeRadius], 0.003, 0.025);
  stepped.spoke_depth_ratio = ratio(model.SpokeDepth() + step[kSpokeDepth], stepped.spoke_radius_m);
  return stepped;
}

}  // namespace

ValveModel UsualValve(double rim_radius_m, double tube_radius_m, int spokes, double dish_m) {
  ValveModel model;
  model.rim_radius_m = std::clamp(rim_radius_m, 0.030, 0.400);
  model.tube_radius_m = std::clamp(tube_radius_m, 0.003, 0.030);
  model.spokes = spokes;
  model.dish_m = std::clamp(dish_m, -0.060, 0.120);
  model.spoke_radius_m = std::max(0.003, kSpokePerTube * model.tube_radius_m);
  model.hub_radius_m = kHubPerRim * model.rim_radius_m;
  return model;
}

ValveModel UsualLever(double length_m, double tube_radius_m, double head_radius_m) {
  ValveModel model;
  model.kind = ValveModel::Kind::kLever;
  model.lever_length_m = std::clamp(length_m, 0.060, kMaxLeverLength_m);
  model.tube_radius_m = std::clamp(tube_radius_m, 0.005, 0.025);
  model.hub_radius_m = std::clamp(head_radius_m, model.tube_radius_m, 0.045);
  model.spokes = 0;
  return model;
}

ValveCandidate Retract(const ValveCandidate& valve, const ValveStep& step) {
  const Eigen::Quaterniond& rotation = valve.base_from_object.rotation();
  const Eigen::Vector3d turn = step.segment<3>(kTiltX);
  const double angle = turn.norm();
  const Eigen::Quaterniond turned =
      angle > 0.0 ? rotation * Eigen::Quaterniond(Eigen::AngleAxisd(angle, turn / angle))
                  : rotation;
  const ValveModel& model = valve.model;
  return {
      Rigid<frame::Base, frame::Object>(
          turned, valve.base_from_object.translation() + rotation * step.segment<3>(kMoveX)),
      model.IsLever()
          ? UsualLever(model.lever_length_m + step[kRimRadius],
                       model.tube_radius_m + step[kTubeRadius], model.hub_radius_m + step[kDish])
          : StepWheel(model, step),
      valve.log_likelihood, std::clamp(valve.brightness * std::exp(step[kBrightness]), 0.1, 10.0)};
}

Eigen::Vector2d AxisPriorResiduals(const ValveCandidate& valve, const std::optional<Plane>& wall) {
  if (!wall) return Eigen::Vector2d::Zero();
  const auto& pose = valve.base_from_object;
  const Eigen::Vector2d tilt(pose.Rotate(Eigen::Vector3d::UnitX()).dot(wall->normal),
                             pose.Rotate(Eigen::Vector3d::UnitY()).dot(wall->normal));
  if (valve.model.IsLever())
    return {tilt.x() * SquareWeight(tilt.x() * tilt.x()),
            tilt.y() / ValvePrior::kLeverTurnSigma_rad};
  return tilt * SquareWeight(tilt.squaredNorm());
}

double OwnSizeResidual(const ValveModel& model) {
  return model.IsLever()
             ? (model.hub_radius_m - ValvePrior::kHeadRadius_m) / ValvePrior::kHeadRadiusSigma_m
             : (model.dish_m - ValvePrior::kDish_m) / ValvePrior::kDishSigma_m;
}

Eigen::Vector3d SectionResiduals(const ValveModel& model) {
  if (model.IsLever()) return Eigen::Vector3d::Zero();
  const auto residual = [](double size_m, double usual_m) {
    return std::log(size_m / usual_m) / ValvePrior::kSectionSigma;
  };
  const double rim =
      std::log(model.RimDepth() / ValvePrior::kRimDepth_m) / ValvePrior::kRimDepthSigma;
  if (model.spokes == 0) return {rim, 0.0, 0.0};
  return {rim, residual(model.spoke_radius_m, ValvePrior::kSpokeRadius_m),
          residual(model.SpokeDepth(), ValvePrior::kSpokeDepth_m)};
}

double LogPrior(const ValveCandidate& valve, const std::optional<Plane>& wall) {
  const ValveModel& model = valve.model;
  const double tube =
      (model.tube_radius_m - ValvePrior::kTubeRadius_m) / ValvePrior::kTubeRadiusSigma_m;
  const double own = OwnSizeResidual(model);
  return -0.5 *
         (Squared(tube) + Squared(own) +
          Squared(std::log(valve.brightness) / ValvePrior::kBrightnessSigma) +
          SectionResiduals(model).squaredNorm() + AxisPriorResiduals(valve, wall).squaredNorm());
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
