#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/objects/solid_part.h"

namespace foresight {

/// A drill as it stands there, in the object's frame: x = the way the bit points, z = up from the
/// surface that the foot stands on, y = z cross x; the origin is where the body's axis intersects
/// that surface (DrillTruth has the same frame). Made from a DrillTemplate (drill_template.h) by
/// choosing scale, tilt and bit; it holds all that is needed to draw it and to grasp it.
struct DrillModel {
  std::string template_name;
  double scale = 1.0;
  /// The body's own lean about x and y of the object, against the foot; the head goes with it.
  Eigen::Vector2d body_tilt_rad = Eigen::Vector2d::Zero();
  double bit_length_m = 0.0;     ///< 0 = no bit
  std::vector<SolidPart> parts;  ///< scaled and leaning

  /// Where a hand goes: origin on the body's axis at grasp height, x = the way the bit points, z =
  /// up along the leaning body.
  Rigid<frame::Object, frame::Object> object_from_grasp;
  Eigen::Vector3d trigger_m = Eigen::Vector3d::Zero();  ///< the trigger's face
  Eigen::Vector3d bit_tip_m = Eigen::Vector3d::Zero();  ///< the chuck's face without a bit

  /// Fails with kInvalidOptions: no parts, a size that is not above 0, a scale outside 0.5 to 2.
  Status Check() const;
  /// Signed distance of a point in the object's frame to the nearest part's surface, metres.
  double Distance(const Eigen::Vector3d& point) const;
};

/// The turn about the object's origin that a body's lean stands for.
Eigen::Quaterniond BodyTurn(const Eigen::Vector2d& body_tilt_rad);
/// The lean that takes the body's axis where `turn` takes it.
Eigen::Vector2d LeanOf(const Eigen::Quaterniond& turn);

Wireframe WireframeOf(const DrillModel& model);

}  // namespace foresight
