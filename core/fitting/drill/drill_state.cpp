#include "core/fitting/drill/drill_state.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/squared.h"

namespace foresight {
namespace {

constexpr double kReach = 3.0;  // sigmas of a proportion

struct Proportion {
  DrillParameter parameter;
  double DrillPrior::*sigma;
};
constexpr std::array kProportions = {
    Proportion{kDrillHeadUp, &DrillPrior::head_up_sigma_m},
    Proportion{kDrillFront, &DrillPrior::front_sigma_m},
    Proportion{kDrillBack, &DrillPrior::back_sigma_m},
    Proportion{kDrillNose, &DrillPrior::nose_sigma},
    Proportion{kDrillChuck, &DrillPrior::chuck_sigma},
    Proportion{kDrillChuckLonger, &DrillPrior::chuck_longer_sigma_m},
    Proportion{kDrillFoot, &DrillPrior::foot_sigma},
    Proportion{kDrillFootForward, &DrillPrior::foot_forward_sigma_m},
    Proportion{kDrillRake, &DrillPrior::rake_sigma_rad},
    Proportion{kDrillFootHeight, &DrillPrior::foot_height_sigma},
    Proportion{kDrillGrip, &DrillPrior::grip_sigma},
    Proportion{kDrillHead, &DrillPrior::head_sigma}};

}  // namespace

TableFrame FrameOf(const Plane& table, const Eigen::Vector3d& near_point) {
  const Eigen::Vector3d& z = table.normal;
  const Eigen::Vector3d x = z.unitOrthogonal();
  Eigen::Matrix3d rotation;
  rotation << x, z.cross(x), z;
  return {rotation, near_point - table.Distance(near_point) * z};
}

DrillModel DrillState::Model() const {
  return kind->Make(values[kDrillScale], {values[kDrillTiltX], values[kDrillTiltY]},
                    values[kDrillBit],
                    {.head_up_m = values[kDrillHeadUp],
                     .front_m = values[kDrillFront],
                     .back_m = values[kDrillBack],
                     .nose_fraction = 1.0 + values[kDrillNose],
                     .chuck_fraction = 1.0 + values[kDrillChuck],
                     .chuck_longer_m = values[kDrillChuckLonger],
                     .foot_fraction = 1.0 + values[kDrillFoot],
                     .foot_height_fraction = 1.0 + values[kDrillFootHeight],
                     .grip_fraction = 1.0 + values[kDrillGrip],
                     .head_fraction = 1.0 + values[kDrillHead],
                     .foot_forward_m = values[kDrillFootForward],
                     .rake_rad = values[kDrillRake]});
}

Rigid<frame::Base, frame::Object> DrillState::Pose(const TableFrame& base_from_table) const {
  return base_from_table *
         Rigid<frame::Object, frame::Object>(
             Eigen::Quaterniond(Eigen::AngleAxisd(values[kDrillYaw], Eigen::Vector3d::UnitZ())),
             values.head<3>());
}

double DrillPrior::operator()(const DrillState& state) const {
  const DrillStep& v = state.values;
  const double tilt = std::hypot(v[kDrillTiltX], v[kDrillTiltY]);
  if (v[kDrillScale] < state.kind->min_scale || v[kDrillScale] > state.kind->max_scale ||
      v[kDrillBit] < 0.0 || v[kDrillBit] > state.kind->max_bit_length_m || tilt > max_tilt_rad)
    return -std::numeric_limits<double>::infinity();
  double deviations = Squared(v[kDrillZ] / height_sigma_m) +
                      Squared((v[kDrillScale] - 1.0) / scale_sigma) +
                      Squared(tilt / tilt_sigma_rad);
  for (const auto& [parameter, sigma] : kProportions) {
    const double off = v[parameter] - (parameter == kDrillRake ? state.kind->usual_rake_rad : 0.0);
    if (std::abs(off) > kReach * this->*sigma) return -std::numeric_limits<double>::infinity();
    deviations += Squared(off / this->*sigma);
  }
  return state.kind->log_prior - 0.5 * deviations;
}

DrillStep DrillPrior::Information() const {
  DrillStep information = DrillStep::Ones();
  information[kDrillZ] = 1.0 / Squared(height_sigma_m);
  information[kDrillYaw] = 0.1;
  information[kDrillScale] = 1.0 / Squared(scale_sigma);
  information[kDrillTiltX] = information[kDrillTiltY] = 1.0 / Squared(tilt_sigma_rad);
  information[kDrillBit] = 1.0 / Squared(0.1);
  for (const auto& [parameter, sigma] : kProportions)
    information[parameter] = 1.0 / Squared(this->*sigma);
  return information;
}

DrillStep DrillPrior::Gradient(const DrillState& state) const {
  DrillStep off = state.values;
  off[kDrillScale] -= 1.0;
  off[kDrillRake] -= state.kind->usual_rake_rad;
  for (const int p : {int{kDrillX}, int{kDrillY}, int{kDrillYaw}, int{kDrillBit}}) off[p] = 0.0;
  return -Information().cwiseProduct(off);
}

DrillPrior AnyProportions(DrillPrior prior) {
  prior.head_up_sigma_m *= 1.5;
  prior.front_sigma_m *= 1.5;
  prior.back_sigma_m *= 1.5;
  prior.foot_sigma *= 1.5;
  return prior;
}

DrillState Flipped(const DrillState& state, const DrillPrior& prior) {
  constexpr double kWithin = 0.99;  // of what the prior allows
  DrillState flipped = state;
  flipped.values[kDrillYaw] += std::numbers::pi;
  flipped.values[kDrillTiltX] *= -1.0;
  const double usual = state.kind->usual_rake_rad;
  const double reach = kWithin * kReach * prior.rake_sigma_rad;
  const double rake = std::clamp(-state.values[kDrillRake], usual - reach, usual + reach);
  flipped.values[kDrillRake] = rake;
  flipped.values[kDrillTiltY] = -state.values[kDrillTiltY] - state.values[kDrillRake] - rake;
  const double tilt = std::hypot(flipped.values[kDrillTiltX], flipped.values[kDrillTiltY]);
  const double within = std::min(1.0, kWithin * prior.max_tilt_rad / std::max(1e-9, tilt));
  flipped.values[kDrillTiltX] *= within;
  flipped.values[kDrillTiltY] *= within;
  flipped.values[kDrillFootForward] *= -1.0;
  // How far the head reaches to its new front is not known from its new back.
  for (const int p : {int{kDrillFront}, int{kDrillBack}, int{kDrillNose}, int{kDrillChuck},
                      int{kDrillChuckLonger}})
    flipped.values[p] = 0.0;
  return flipped;
}

double TurnBetween(double yaw_a, double yaw_b) {
  return std::abs(std::remainder(yaw_a - yaw_b, 2.0 * std::numbers::pi));
}

DrillCandidate CandidateOf(const DrillState& state, const TableFrame& base_from_table) {
  return {state.Pose(base_from_table), state.Model(), state.log_likelihood};
}

}  // namespace foresight
