#pragma once

#include <numbers>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/simulation/shapes.h"

namespace foresight {

/// Something round as a foundry draws it; frame as ValveModel's, the middle of the rim's section in
/// z = 0.
struct OtherWheel {
  enum class Section { kRound, kFlatBar, kUprightBar, kHalfRound };
  std::string name;  ///< how it was drawn
  double radius_m = 0.15;
  Section rim = Section::kRound;
  Eigen::Vector2d rim_m = {0.02, 0.02};  ///< radial and axial size of the section
  double rim_begin_rad = 0.0;            ///< a broken rim begins here ...
  double rim_arc_rad = 2.0 * std::numbers::pi;
  double waves_m = 0.0;  ///< of the rim's radius, as a grip has them
  int waves = 0;
  std::vector<double> spokes_rad;
  Section spoke = Section::kRound;
  Eigen::Vector2d spoke_m = {0.012, 0.012};  ///< across and axial, at the hub
  double spoke_taper = 1.0;                  ///< of it at the rim
  double spoke_bow_m = 0.0;                  ///< its middle lies this much nearer to the viewer
  double dish_m = 0.02;
  double hub_radius_m = 0.025;
  double hub_length_m = 0.03;
  double web_m = 0.0;           ///< thickness of a plate between hub and rim; 0 = none
  std::vector<double> rings_m;  ///< radii of more rings, as a guard has them
  double knob_m = 0.0;          ///< height of a spinner's knob on the rim
};

/// A wheel with every section, hub and spoke drawn anew.
OtherWheel DrawWheel(Random& random);
/// Something with a rim that is meant to be no handwheel: a broken one, a fan's guard, a steering
/// wheel with a T, a pulley, a hoop, a plate, a gear's blank.
OtherWheel DrawRoundThing(Random& random);

Shape ShapeOf(const OtherWheel& wheel);

/// What a shape is when it is looked at along its axis (16,000 rays), whoever drew it.
struct WheelMeasures {
  bool closed_rim = false;  ///< 97 % of all directions have it, about as far out (waves of a grip)
  double radius_m = 0.0;    ///< its middle, on average over the directions
  int spokes = 0;           ///< between hub and rim
  double first_spoke_rad = 0.0;
  double unevenness_rad = 0.0;  ///< of their directions
  double open = 0.0;            ///< fraction of the ring between hub and rim that is seen through
  bool hub = false;

  /// A rim of 45 to 240 mm radius on 2 to 6 spokes that stand evenly within 8 deg, 40 % open.
  bool IsHandwheel() const;
};
WheelMeasures MeasureWheel(const Shape& shape);

}  // namespace foresight
