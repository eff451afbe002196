#pragma once

#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/objects/valve_model.h"
#include "core/simulation/scene_objects.h"
#include "core/simulation/shapes.h"

namespace foresight {

/// Sections of rim and spokes, and the hub, of a handwheel as it is made. Widths and depths are
/// halves, in metres; depth is along the axis.
struct VariedWheel {
  enum class Section { kOval, kBar, kPressed /* an arch with a flat back */ };
  std::string made;  ///< "cast", "plate", "rolled", "pressed"
  double radius_m = 0.15;
  double rim_arc_rad = 0.0;  ///< of a broken rim, from x on; a whole turn = not broken
  Section rim = Section::kOval;
  double rim_width_m = 0.012;
  double rim_depth_m = 0.012;
  std::vector<double> spokes_rad;
  Section spoke = Section::kOval;
  double spoke_width_m = 0.008;  ///< at the hub
  double spoke_depth_m = 0.008;
  double spoke_taper = 1.0;  ///< width at the rim to that at the hub
  double dish_m = 0.0;
  double hub_radius_m = 0.02;
  double hub_length_m = 0.03;  ///< 0 = no boss
  double hub_forward_m = 0.0;  ///< of the boss's middle, from where the spokes meet
};

/// A handwheel with the rim's radius, the spokes (two at least) and the dish of `like`, made one of
/// four ways:
///   cast       oval sections, up to a third deeper or flatter, spokes that taper
///   plate      cut from one plate of 5 to 14 mm: wide and flat, no dish, a boss welded in
///   rolled     a flat bar of 4 to 8 mm on edge, 14 to 40 mm deep; rods or flat bars as spokes
///   pressed    sheet arched to the front, wide flat spokes
VariedWheel RandomVariedWheel(const ValveModel& like, Random& random);

/// Made like one, and no handwheel: a ring without spokes, a cross without a rim, a wheel that has
/// lost a spoke, half a wheel. `what` is set to its name.
VariedWheel RandomAlmostWheel(const ValveModel& like, Random& random, std::string& what);

/// With its boss; frame as ValveModel's.
Shape ShapeOf(const VariedWheel& wheel);

/// Adds the wheel with its boss, in the pose and of the material of `valve`.
void AddVariedWheel(const VariedWheel& wheel, const ValveObject& valve, Scene& scene);

/// What the fit should find of it.
ValveModel ModelOf(const VariedWheel& wheel);

}  // namespace foresight
