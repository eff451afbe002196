#include "core/fitting/drill/drill_state.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/squared.h"

namespace foresight {
namespace {

constexpr double kReach = 3.0;  // sigmas of head and foot

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
                    {values[kDrillHeadUp], values[kDrillHeadForward], 1.0 + values[kDrillFoot]});
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
  if (std::abs(v[kDrillHeadUp]) > kReach * head_up_sigma_m ||
      std::abs(v[kDrillHeadForward]) > kReach * head_forward_sigma_m ||
      std::abs(v[kDrillFoot]) > kReach * foot_sigma)
    return -std::numeric_limits<double>::infinity();
  return state.kind->log_prior -
         0.5 *
             (Squared(v[kDrillZ] / height_sigma_m) + Squared((v[kDrillScale] - 1.0) / scale_sigma) +
              Squared(tilt / tilt_sigma_rad) + Squared(v[kDrillHeadUp] / head_up_sigma_m) +
              Squared(v[kDrillHeadForward] / head_forward_sigma_m) +
              Squared(v[kDrillFoot] / foot_sigma));
}

DrillPrior AnyProportions(DrillPrior prior) {
  prior.head_up_sigma_m *= 1.5;
  prior.head_forward_sigma_m *= 2.5;  // +-45 mm
  prior.foot_sigma *= 1.5;
  return prior;
}

DrillState Flipped(const DrillState& state) {
  DrillState flipped = state;
  flipped.values[kDrillYaw] += std::numbers::pi;
  flipped.values[kDrillTiltX] *= -1.0;
  flipped.values[kDrillTiltY] *= -1.0;
  // How far the head reaches to its new front is not known from its new back.
  flipped.values[kDrillHeadForward] = 0.0;
  return flipped;
}

double TurnBetween(double yaw_a, double yaw_b) {
  return std::abs(std::remainder(yaw_a - yaw_b, 2.0 * std::numbers::pi));
}

DrillCandidate CandidateOf(const DrillState& state, const TableFrame& base_from_table) {
  return {state.Pose(base_from_table), state.Model(), state.log_likelihood};
}

}  // namespace foresight
