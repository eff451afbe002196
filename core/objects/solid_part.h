#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/rigid.h"

namespace foresight {

/// One solid of a template, in the object's frame.
struct SolidPart {
  enum class Shape {
    kBox,       ///< size_m along its own axes
    kCylinder,  ///< capped; along z: size_m = (diameter, diameter, length)
    kCapsule,   ///< a cylinder with round ends; length without them
  };

  std::string name;  ///< what it is: "body", "head", "chuck", "bit", "battery foot", "trigger"
  Shape shape = Shape::kBox;
  Rigid<frame::Object, frame::Object> object_from_part;  ///< the part's middle
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();
  /// Of a capsule's ends, that at -z first: where another part goes on, which show no outline.
  std::array<bool, 2> joined = {false, false};

  /// Fails with kInvalidOptions, naming the part: a size that is not above 0, a pose that is not
  /// finite, a cylinder or capsule that is not round.
  Status Check() const;
  /// Signed distance of a point in the object's frame to the surface, metres.
  double Distance(const Eigen::Vector3d& point) const;
};

/// Closed or open polylines of a template in the object's frame, for drawing.
using Wireframe = std::vector<std::vector<Eigen::Vector3d>>;
Wireframe WireframeOf(const SolidPart& part);
/// A circle of 64 corners around z, closed.
std::vector<Eigen::Vector3d> CircleAroundZ(double radius, double z);

}  // namespace foresight
