#pragma once

#include <optional>

#include "core/objects/drill_template.h"

namespace foresight {

// Tools that a drill is mistaken for, made of the drill's own template, so that a fit can ask how
// much better the drill explains the rays than such a tool in the pose and size that suits the tool
// best. Template's frame and units (drill_template.h).

/// The drill with a grip that goes down to the table instead of a foot, as hot air tools on the end
/// of their grip have; nullopt for a kind without feet.
std::optional<DrillTemplate> WithoutFoot(const DrillTemplate& kind);

/// The drill with a head that goes on in the chuck's place, 0.88 times as wide as it is, as lamps
/// and blowers on a grip have; nullopt for a kind without head or chuck. A bit may stick out of it.
std::optional<DrillTemplate> WithBluntHead(const DrillTemplate& kind);

}  // namespace foresight
