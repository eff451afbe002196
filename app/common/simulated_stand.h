#pragma once

#include <memory>

#include "core/simulation/world.h"
#include "hardware/api/moving_stand.h"

namespace foresight {

/// The stand of a simulated world; nullptr where its scene has no places of a stand with a mount of
/// boards.
std::shared_ptr<MovingStand> StandIn(std::shared_ptr<const World> world);

}  // namespace foresight
