#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/base/result.h"
#include "core/objects/solid_part.h"

namespace foresight {

/// A valve in the object's frame; z is the axis of rotation pointing to the viewer.
///
/// A wheel's rim is a ring in the plane z = 0 around the origin, x points along the first spoke.
/// The sections of rim and spokes are ellipses: as wide as their radius says, and deeper or flatter
/// along the axis by their depth ratio.
/// The hub lies at z = -dish (away from the viewer for a positive dish, as handwheels are built)
/// and carries the spokes.
///
/// A lever's bar runs from the origin, its pivot, along x. A round head sits on the pivot and a
/// stem leads back from it. Rim, spokes and dish mean nothing there.
struct ValveModel {
  enum class Kind { kWheel, kLever };

  double rim_radius_m = 0.10;     ///< centre of the rim's tube
  double tube_radius_m = 0.012;   ///< half the rim's width, or half a lever's thickness
  int spokes = 3;                 ///< 0 = a disc, else 2 to 6
  double spoke_radius_m = 0.008;  ///< half a spoke's width, or half a disc's thickness
  double hub_radius_m = 0.020;    ///< or of the head on a lever's pivot
  double dish_m = 0.0;
  Kind kind = Kind::kWheel;
  double lever_length_m = 0.0;     ///< from the pivot to the middle of its round end
  double rim_depth_ratio = 1.0;    ///< depth of the rim's section to its width; 1 = round
  double spoke_depth_ratio = 1.0;  ///< the same of a spoke; a disc and a lever have neither

  /// Half the depth of the rim's section along the axis.
  double RimDepth() const { return rim_depth_ratio * tube_radius_m; }
  /// Half the depth of a spoke's section, across the spoke.
  double SpokeDepth() const { return spoke_depth_ratio * spoke_radius_m; }

  static constexpr double kLeverStem_m = 0.05;     ///< length of a lever's stem
  static constexpr double kLeverStemPerHub = 0.6;  ///< its radius, as a fraction of the head's

  bool IsLever() const { return kind == Kind::kLever; }

  Status Check() const;

  /// Signed distance of a point in the object's frame to the valve's surface, metres; exact
  /// outside.
  double Distance(const Eigen::Vector3d& point) const;
};

/// "wheel", "lever": the kind in files.
const char* ToString(ValveModel::Kind kind);

Wireframe WireframeOf(const ValveModel& model);

}  // namespace foresight
