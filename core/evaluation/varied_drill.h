#pragma once

#include "core/base/random.h"
#include "core/simulation/scene.h"

namespace foresight {

/// A drill of the proportions that cordless drills and drivers have, not those of a template with a
/// tenth more or less: heads 120 to 230 mm long of revolved outlines, up to a fifth narrower than
/// high, with flat or round backs and stepped or conical chucks; oval grips that lean by
/// -5 to 18 deg under a level head, as pistol grips do, and bow by up to 8 mm; slide packs, flat
/// packs and the small feet of 12 V drivers; hooks, side handles, bits of 0 to 130 mm; 170 to 290
/// mm tall.
struct VariedDrill {
  double foot_length_m = 0.0;
  double foot_width_m = 0.0;
  double foot_height_m = 0.0;
  double foot_forward_m = 0.0;
  double neck_m = 0.0;  ///< height of a narrower neck above the foot; 0 = none
  Eigen::Vector2d grip_half_m = Eigen::Vector2d::Zero();  ///< along x and across
  double rake_rad = 0.0;  ///< of the grip: positive = its upper end is further in front
  double bow_m = 0.0;     ///< how far its middle is in front of the line between its ends
  double head_height_m = 0.0;
  double head_radius_m = 0.0;
  double head_flattened = 1.0;  ///< its width to its height
  double head_back_m = 0.0;     ///< behind the grip where it meets the head
  double head_front_m = 0.0;    ///< to the chuck
  double gear_radius_m = 0.0;   ///< at the chuck
  double chamfer_m = 0.0;       ///< of the back: 0 = flat
  double chuck_radius_m = 0.0;
  double chuck_length_m = 0.0;
  double chuck_taper = 1.0;  ///< radius of its face to that of its root
  double bit_length_m = 0.0;
  bool trigger = true;
  bool hook = false;
  bool side_handle = false;
};

VariedDrill RandomVariedDrill(Random& random);

/// Materials of shell, grip and metal.
struct DrillMaterials {
  Material shell;
  Material grip;
  Material metal;
};

/// Stands it where its grip's axis meets the place's origin, and adds its truth.
void AddVariedDrill(const VariedDrill& drill, const DrillMaterials& materials,
                    const Rigid<frame::Robot, frame::Object>& robot_from_place, Scene& scene);

}  // namespace foresight
