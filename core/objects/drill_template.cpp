#include "core/objects/drill_template.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/contract.h"
#include "core/geometry/rotation_between.h"

namespace foresight {
namespace {

constexpr double kShortestBit_m = 0.002;
constexpr double kLargest_m = 1.0;  // of what a hand holds
constexpr std::ptrdiff_t kMostParts = 64;

bool WithinHand(const Eigen::Vector3d& point_m) {
  return (point_m.array().abs() <= kLargest_m).all();
}

SolidPart Bit(const Eigen::Vector3d& chuck_face_m, const Eigen::Vector3d& direction,
              double radius_m, double length_m) {
  SolidPart bit;
  bit.name = "bit";
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

}  // namespace

Status DrillTemplate::Check() const {
  if (!(min_scale >= 0.5 && min_scale <= 1.0 && max_scale >= 1.0 && max_scale <= 2.0))
    return Fail(ErrorCode::kInvalidOptions,
                "drill template '{}': scale {} to {} does not hold 1 within 0.5 to 2", name,
                min_scale, max_scale);
  if (!(log_prior <= 0.0 && log_prior >= -1000.0))
    return Fail(ErrorCode::kInvalidOptions,
                "drill template '{}': log_prior {} is not within -1000 to 0", name, log_prior);
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
  DrillModel model;
  model.template_name = name;
  model.scale = scale;
  model.body_tilt_rad = body_tilt_rad;
  model.bit_length_m = bit_length_m < kShortestBit_m ? 0.0 : bit_length_m;
  model.parts.reserve(parts.size() + 1);
  const double least_up_m = -0.5 * scale * Body().size_m.z();  // a short body stays one
  const Eigen::Vector3d up(0.0, 0.0, std::max(proportions.head_up_m, least_up_m));
  const Eigen::Vector3d forward(proportions.head_forward_m, 0.0, 0.0);
  const double grasp_height_m = object_from_grasp.translation().z();
  for (const SolidPart& part : parts) {
    SolidPart made = Scaled(part, scale);
    if (part.name == kBody)
      Lengthen(made, up.z());
    else if (part.name == kFoot)
      made.size_m.head<2>() *= proportions.foot_fraction;
    else if (part.object_from_part.translation().z() > grasp_height_m)
      Move(made, part.name == kTrigger ? up : Eigen::Vector3d(up + forward));
    if (part.name != kFoot) made.object_from_part = lean * made.object_from_part;
    model.parts.push_back(std::move(made));
  }
  // A bit is no part of the drill's size: it begins at the scaled chuck and keeps its own length.
  const Eigen::Vector3d chuck_face = scale * chuck_face_m + up + forward;
  if (model.bit_length_m > 0.0) {
    SolidPart bit = Bit(chuck_face, bit_direction, bit_radius_m, model.bit_length_m);
    bit.object_from_part = lean * bit.object_from_part;
    model.parts.push_back(std::move(bit));
  }
  model.object_from_grasp =
      lean * Rigid<frame::Object, frame::Object>(object_from_grasp.rotation(),
                                                 scale * object_from_grasp.translation());
  // The trigger hangs under the head; a cut-out tool's switch stays with the grip.
  const double trigger_up_m = trigger_m.z() > grasp_height_m ? up.z() : 0.0;
  model.trigger_m =
      lean * Eigen::Vector3d(scale * trigger_m + trigger_up_m * Eigen::Vector3d::UnitZ());
  model.bit_tip_m = lean * Eigen::Vector3d(chuck_face + model.bit_length_m * bit_direction);
  return model;
}

}  // namespace foresight
