#pragma once

#include <vector>

#include "core/objects/solid_part.h"

namespace foresight {

/// What a cordless hot air or glue tool has in place of a chuck: a nozzle longer than any chuck,
/// which a fit explains by a chuck and a bit, or by a longer head. The drill's parts (object's
/// frame) with a nozzle in place of chuck and bit, in each way it may lie: up to the chuck's face
/// or the bit's tip, as thick as the chuck or thinner; the head ends where the nozzle begins. Empty
/// for a drill without a chuck. @pre nozzle_m > 0
std::vector<std::vector<SolidPart>> WithNozzles(const std::vector<SolidPart>& drill,
                                                double nozzle_m);

}  // namespace foresight
