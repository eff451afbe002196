#pragma once

#include <span>

#include "core/base/random.h"
#include "core/simulation/scene.h"

namespace foresight {

/// Things that hang where a valve could and are none.
enum class Distractor {
  kEmptyRegion,  ///< nothing nearer than the room's far wall
  kEmptyWall,
  kBox,
  kBall,
  kPipe,
  kHalfWheel,
  kCableCoil,
  kTableEdge,
  kBicycleWheel,
  kSquareFrame,
};

std::span<const Distractor> Distractors();
/// "half a wheel".
const char* NameOf(Distractor thing);

/// Where a distractor goes: its place, the way it faces, its size and how far behind the wall is.
struct DistractorPlace {
  Rigid<frame::Robot, frame::Object> robot_from_object;
  double radius_m = 0.15;
  double wall_m = 0.12;
};

void AddDistractor(Distractor thing, const DistractorPlace& place, const Material& material,
                   Random& random, Scene& scene);

}  // namespace foresight
