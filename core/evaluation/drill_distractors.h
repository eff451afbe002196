#pragma once

#include <span>

#include "core/base/random.h"
#include "core/simulation/scene.h"

namespace foresight {

/// Things that stand where a drill could and are none.
enum class DrillDistractor {
  kNothing,  ///< the table alone
  kWall,     ///< and no table either
  kTableEdge,
  kBox,
  kBottle,
  kBoxBesideCylinder,
  kBoxOnCylinder,  ///< like a T
  kLamp,
  kMug,
  kSprayCan,
};

std::span<const DrillDistractor> DrillDistractors();
/// "box on a cylinder".
const char* NameOf(DrillDistractor thing);

/// Stands it at a place of a table, in robot; what is nothing, wall or edge adds nothing.
void AddDrillDistractor(DrillDistractor thing, const Rigid<frame::Robot, frame::Object>& place,
                        const Material& material, Random& random, Scene& scene);

}  // namespace foresight
