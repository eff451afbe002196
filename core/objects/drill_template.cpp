#include "core/objects/drill_template.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/contract.h"
#include "core/geometry/angles.h"
#include "core/geometry/rotation_between.h"

namespace foresight {
namespace {

constexpr double kMostRake_rad = 0.4;
constexpr double kShortestBit_m = 0.002;
constexpr double kLargest_m = 1.0;  // of what a hand holds
constexpr std::ptrdiff_t kMostParts = 64;

bool WithinHand(const Eigen::Vector3d& point_m) {
  return (point_m.array().abs() <= kLargest_m).all();
}

SolidPart Bit(const Eigen::Vector3d& chuck_face_m, const Eigen::Vector3d& direction,
              double radius_m, double length_m) {
  SolidPart bit;
  bit.name = DrillTemplate::kBit;
  bit.shape = SolidPart::Shape::kCylinder;
  bit.object_from_part = {RotationBetween(Eigen::Vector3d::UnitZ(), direction),
                          chuck_face_m + 0.5 * length_m * direction};
  bit.size_m = {2.0 * radius_m, 2.0 * radius_m, length_m};
  return bit;
}

SolidPart Scaled(const SolidPart& part, double scale) {
  SolidPart scaled = part;
  scaled.size_m *= scale;
  scaled.object_from_part = {part.object_from_part.rotation(),
                             scale * part.object_from_part.translation()};
  return scaled;
}

void Move(SolidPart& part, const Eigen::Vector3d& by) {
  part.object_from_part = {part.object_from_part.rotation(),
                           part.object_from_part.translation() + by};
}

/// The body grows at its upper end; its axis is z.
void Lengthen(SolidPart& body, double by_m) {
  body.size_m.z() += by_m;
  Move(body, {0.0, 0.0, 0.5 * by_m});
}

/// The axis of a part that lies along x of the object; -1 = it does not.
int AxisAlongX(const SolidPart& part) {
  constexpr double kAlong = 0.99;
  const Eigen::Vector3d x = part.object_from_part.Inverse().Rotate(Eigen::Vector3d::UnitX());
  Eigen::Index axis = 0;
  return x.cwiseAbs().maxCoeff(&axis) > kAlong ? static_cast<int>(axis) : -1;
}

/// Moves the ends of a part of the head: what reaches behind the body's axis gets longer there,
/// what ends before it in front, and what begins before it moves.
void Stretch(SolidPart& part, double front_m, double back_m) {
  constexpr double kAtAxis_m = 0.005;
  constexpr double kShortest_m = 0.005;
  const int axis = AxisAlongX(part);
  if (axis < 0) return;
  const double half = 0.5 * part.size_m[axis], middle = part.object_from_part.translation().x();
  const auto moved = [&](double end) {
    return end < -kAtAxis_m ? end - back_m : end > kAtAxis_m ? end + front_m : end;
  };
  const double from = moved(middle - half);
  const double to = std::max(moved(middle + half), from + kShortest_m);
  part.size_m[axis] = to - from;
  Move(part, {0.5 * (from + to) - middle, 0.0, 0.0});
}

/// A part that lies along x grows at its front end; a tenth of it is left.
void LengthenForward(SolidPart& part, double by_m) {
  const int axis = AxisAlongX(part);
  if (axis < 0) return;
  const double by = std::max(by_m, -0.9 * part.size_m[axis]);
  part.size_m[axis] += by;
  Move(part, {0.5 * by, 0.0, 0.0});
}

/// Grows about the table.
void Heighten(SolidPart& foot, double fraction) {
  const Eigen::Vector3d middle = foot.object_from_part.translation();
  foot.size_m.z() *= fraction;
  Move(foot, {0.0, 0.0, (fraction - 1.0) * middle.z()});
}

/// The body reaches down to a lower foot.
void ReachDown(SolidPart& body, double foot_height_fraction) {
  const double low_m = body.object_from_part.translation().z() - 0.5 * body.size_m.z();
  const double by_m = std::max(0.0, (1.0 - foot_height_fraction) * low_m);
  body.size_m.z() += by_m;
  Move(body, {0.0, 0.0, -0.5 * by_m});
}

/// Across its length: a round part, or a box that lies along x.
void Thicken(SolidPart& part, double fraction) {
  if (part.shape != SolidPart::Shape::kBox) {
    part.size_m.head<2>() *= fraction;
    return;
  }
  const int axis = AxisAlongX(part);
  if (axis < 0) return;
  for (int i = 0; i < 3; ++i)
    if (i != axis) part.size_m[i] *= fraction;
}

/// Of round parts.
void Widen(SolidPart& part, double fraction) {
  if (part.shape != SolidPart::Shape::kBox) part.size_m.head<2>() *= fraction;
}

/// Gives a part of the head, where the template has it, the drill's own front, back, nose and
/// chuck.
void ChangeHead(SolidPart& part, const DrillProportions& proportions) {
  Stretch(part, proportions.front_m, proportions.back_m);
  if (part.name == DrillTemplate::kHead) Thicken(part, proportions.head_fraction);
  if (part.name == DrillTemplate::kGearCase) Widen(part, proportions.nose_fraction);
  if (part.name != DrillTemplate::kChuck) return;
  Widen(part, proportions.chuck_fraction);
  LengthenForward(part, proportions.chuck_longer_m);
}

/// What stands on the table as the drill has it.
SolidPart OwnFoot(SolidPart part, const DrillProportions& proportions) {
  part.size_m.head<2>() *= proportions.foot_fraction;
  Heighten(part, proportions.foot_height_fraction);
  Move(part, {proportions.foot_forward_m, 0.0, 0.0});
  return part;
}

/// The body as the drill has it, before it leans.
void ChangeBody(SolidPart& body, double up_m, const DrillProportions& proportions) {
  Lengthen(body, up_m);
  ReachDown(body, proportions.foot_height_fraction);
  body.size_m.head<2>() *= proportions.grip_fraction;
}

}  // namespace

Status DrillTemplate::Check() const {
  if (!(min_scale >= 0.5 && min_scale <= 1.0 && max_scale >= 1.0 && max_scale <= 2.0))
    return Fail(ErrorCode::kInvalidOptions,
                "drill template '{}': scale {} to {} does not hold 1 within 0.5 to 2", name,
                min_scale, max_scale);
  if (!(log_prior <= 0.0 && log_prior >= -1000.0))
    return Fail(ErrorCode::kInvalidOptions,
                "drill template '{}': log_prior {} is not within -1000 to 0", name, log_prior);
  if (!(std::abs(usual_rake_rad) <= kMostRake_rad))
    return Fail(ErrorCode::kInvalidOptions,
                "drill template '{}': usual_rake_deg {:.1f} is not within -{:.1f} to {:.1f}", name,
                DegreesFromRadians(usual_rake_rad), DegreesFromRadians(kMostRake_rad),
                DegreesFromRadians(kMostRake_rad));
  if (!(bit_radius_m > 0.0 && bit_radius_m <= 0.5 && max_bit_length_m >= 0.0 &&
        max_bit_length_m <= 0.5))
    return Fail(ErrorCode::kInvalidOptions,
                "drill template '{}': a bit of radius {} m and up to {} m is not usable", name,
                bit_radius_m, max_bit_length_m);
  if (!(std::abs(bit_direction.norm() - 1.0) < 1e-6))
    return Fail(ErrorCode::kInvalidOptions,
                "drill template '{}': the bit's direction has length {}", name,
                bit_direction.norm());
  if (std::ssize(parts) > kMostParts)
    return Fail(ErrorCode::kInvalidOptions, "drill template '{}': {} parts are more than {}", name,
                parts.size(), kMostParts);
  for (const SolidPart& part : parts) {
    FORESIGHT_CHECK(part.Check());
    if (!WithinHand(part.size_m) || !WithinHand(part.object_from_part.translation()))
      return Fail(ErrorCode::kInvalidOptions,
                  "drill template '{}': part '{}' of {} x {} x {} m at ({}, {}, {}) m does not fit "
                  "into {} m; sizes are metres",
                  name, part.name, part.size_m.x(), part.size_m.y(), part.size_m.z(),
                  part.object_from_part.translation().x(), part.object_from_part.translation().y(),
                  part.object_from_part.translation().z(), kLargest_m);
  }
  for (const auto& [member, point] :
       {std::pair("bit's from_m", chuck_face_m), std::pair("trigger_m", trigger_m),
        std::pair("grasp_m", object_from_grasp.translation())})
    if (!WithinHand(point))
      return Fail(ErrorCode::kInvalidOptions,
                  "drill template '{}': {} ({}, {}, {}) is not within {} m of its foot", name,
                  member, point.x(), point.y(), point.z(), kLargest_m);
  const auto is_body = [](const SolidPart& part) { return part.name == kBody; };
  if (std::none_of(parts.begin(), parts.end(), is_body))
    return Fail(ErrorCode::kInvalidOptions, "drill template '{}': no part is named '{}'", name,
                kBody);
  return {};
}

const SolidPart& DrillTemplate::Body() const {
  const auto is_body = [](const SolidPart& part) { return part.name == kBody; };
  const auto found = std::find_if(parts.begin(), parts.end(), is_body);
  FORESIGHT_EXPECTS(found != parts.end(), "a drill template has a body");
  return *found;
}

DrillModel DrillTemplate::Make(double scale, const Eigen::Vector2d& body_tilt_rad,
                               double bit_length_m, const DrillProportions& proportions) const {
  const Rigid<frame::Object, frame::Object> lean(BodyTurn(body_tilt_rad), Eigen::Vector3d::Zero());
  const Rigid<frame::Object, frame::Object> rake(BodyTurn({0.0, proportions.rake_rad}),
                                                 Eigen::Vector3d::Zero());
  DrillModel model;
  model.template_name = name;
  model.scale = scale;
  model.body_tilt_rad = LeanOf(lean.rotation() * rake.rotation());
  model.bit_length_m = bit_length_m < kShortestBit_m ? 0.0 : bit_length_m;
  model.parts.reserve(parts.size() + 1);
  const double least_up_m = -0.5 * scale * Body().size_m.z();  // a short body stays one
  const Eigen::Vector3d up(0.0, 0.0, std::max(proportions.head_up_m, least_up_m));
  const double grasp_height_m = object_from_grasp.translation().z();
  const double slope = std::tan(proportions.rake_rad);
  // By how much what is at a place of the template is moved to lie on the raked grip.
  const auto to_head = [&](const Eigen::Vector3d& at) -> Eigen::Vector3d {
    return up + slope * (at.z() + up.z()) * Eigen::Vector3d::UnitX();
  };
  for (const SolidPart& part : parts) {
    SolidPart made = Scaled(part, scale);
    const bool above_grasp = part.object_from_part.translation().z() > grasp_height_m;
    if (part.name == kFoot) {
      model.parts.push_back(OwnFoot(std::move(made), proportions));
      continue;
    }
    if (above_grasp && part.name != kBody && part.name != kTrigger) {
      ChangeHead(made, proportions);
      Move(made, to_head(made.object_from_part.translation()));
    } else {
      if (part.name == kBody) ChangeBody(made, up.z(), proportions);
      if (part.name == kTrigger && above_grasp) Move(made, up);
      made.object_from_part = rake * made.object_from_part;
    }
    made.object_from_part = lean * made.object_from_part;
    model.parts.push_back(std::move(made));
  }
  // A bit is no part of the drill's size: it begins at the scaled chuck and keeps its own length.
  Eigen::Vector3d chuck_face = scale * chuck_face_m;
  if (bit_direction.x() > 0.5) chuck_face.x() += proportions.front_m + proportions.chuck_longer_m;
  chuck_face += to_head(chuck_face);
  if (model.bit_length_m > 0.0) {
    SolidPart bit = Bit(chuck_face, bit_direction, bit_radius_m, model.bit_length_m);
    bit.object_from_part = lean * bit.object_from_part;
    model.parts.push_back(std::move(bit));
  }
  model.object_from_grasp =
      lean * rake *
      Rigid<frame::Object, frame::Object>(object_from_grasp.rotation(),
                                          scale * object_from_grasp.translation());
  // The trigger hangs under the head; a cut-out tool's switch stays with the grip.
  const double trigger_up_m = trigger_m.z() > grasp_height_m ? up.z() : 0.0;
  model.trigger_m =
      lean * (rake * Eigen::Vector3d(scale * trigger_m + trigger_up_m * Eigen::Vector3d::UnitZ()));
  model.bit_tip_m = lean * Eigen::Vector3d(chuck_face + model.bit_length_m * bit_direction);
  return model;
}

}  // namespace foresight
