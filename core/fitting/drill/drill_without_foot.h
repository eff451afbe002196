#pragma once

#include <optional>

#include "core/objects/drill_template.h"

namespace foresight {

/// What a drill is mistaken for: the drill with a grip that goes down to the table instead of a
/// foot, as hot air tools have that stand on the end of their grip. A template of its own, so that
/// a fit can ask how much better the drill explains the rays than such a tool in the pose and size
/// that suits the tool best. Template's frame and units (drill_template.h); nullopt for a kind
/// without feet.
std::optional<DrillTemplate> WithoutFoot(const DrillTemplate& kind);

}  // namespace foresight
