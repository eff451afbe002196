#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/base/result.h"
#include "core/objects/solid_part.h"

namespace foresight {

/// A door handle in the object's frame. The origin is where the pivot's axis crosses the middle of
/// the lever; x runs along the lever to its longer free end, z is the door's normal, towards the
/// viewer. The lever may go on behind its pivot for a shorter piece. From pivot to end it may be
/// bowed as a parabola: beside the line between both, off it, or towards the door. The door is the
/// plane z = -standoff_m. A neck leads back to it, through a round rosette or a long plate (along
/// y) that lies on the door.
struct HandleModel {
  enum class Plate { kRosette, kLong };

  double length_m = 0.12;    ///< from the pivot's axis to the middle of the lever's round end
  double behind_m = 0.0;     ///< how far it goes on behind the pivot's axis
  double bow_m = 0.0;        ///< how far its middle lies towards y of the line from pivot to end
  double lift_m = 0.0;       ///< how much further its middle is off the door than that line
  double radius_m = 0.010;   ///< half the lever's thickness
  double standoff_m = 0.05;  ///< of the lever's middle from the door
  bool returned = false;     ///< its end is bent back to the door
  Plate plate = Plate::kRosette;

  static constexpr double kPlateThickness_m = 0.009;
  static constexpr double kRosetteRadius_m = 0.026;
  static constexpr double kPlateWidth_m = 0.042;   ///< of a long one
  static constexpr double kPlateLength_m = 0.230;  ///< the pivot lies in its middle
  static constexpr double kReturnGap_m = 0.012;    ///< between a returned end and the door

  /// How much of its bow and lift the lever has at a place along it, 0 at the pivot and 1 at the
  /// end.
  static constexpr double BowAt(double place) { return 4.0 * place * (1.0 - place); }
  /// Fails with kInvalidOptions: a size that is not above 0 or not below a metre, a piece behind
  /// the pivot that is longer than the lever, or a middle further off the line than half its
  /// length.
  Status Check() const;
  /// Signed distance of a point in the object's frame to the handle's surface, metres.
  double Distance(const Eigen::Vector3d& point) const;
};

/// "rosette", "long": the plate in files.
const char* ToString(HandleModel::Plate plate);

/// The lever's middle line, in straight pieces from what lies behind the pivot to the end.
std::vector<Eigen::Vector3d> LeverPathOf(const HandleModel& model);

/// Lever, neck, a returned end: round bars, from one end's middle to the other's.
struct HandleBar {
  Eigen::Vector3d from, to;
  double radius_m = 0.0;
};
std::vector<HandleBar> BarsOf(const HandleModel& model);

Wireframe WireframeOf(const HandleModel& model);

}  // namespace foresight
