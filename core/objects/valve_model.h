#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/base/result.h"
#include "core/objects/solid_part.h"

namespace foresight {

/// A wheel valve in the object's frame: the rim is a torus in the plane z = 0 around the origin, z
/// is the axis of rotation pointing to the viewer, x points along the first spoke. The hub lies at
/// z = -dish (away from the viewer for a positive dish, as handwheels are built) and carries the
/// spokes.
struct ValveModel {
  double rim_radius_m = 0.10;  ///< centre of the rim's tube
  double tube_radius_m = 0.012;
  int spokes = 3;  ///< 0 = a disc, else 2 to 6
  double spoke_radius_m = 0.008;
  double hub_radius_m = 0.020;
  double dish_m = 0.0;

  Status Check() const;

  /// Signed distance of a point in the object's frame to the valve's surface, metres; exact
  /// outside.
  double Distance(const Eigen::Vector3d& point) const;
};

Wireframe WireframeOf(const ValveModel& model);

}  // namespace foresight
