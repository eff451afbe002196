#pragma once

#include <optional>
#include <vector>

#include "core/objects/drill_template.h"

namespace foresight {

// Tools that stand like drills and are mistaken for one, made of the drill that they are mistaken
// for. Parts and templates in the object's frame, as drill_template.h says.

/// The drill with a grip that goes down to the table instead of a foot, as hot air tools have that
/// stand on the end of their grip. A template of its own, so that a fit can ask how much better the
/// drill explains the rays than such a tool in the pose and size that suits the tool best. nullopt
/// for a kind without feet.
std::optional<DrillTemplate> WithoutFoot(const DrillTemplate& kind);

/// The drill with a head that goes on as thick as it is to where the chuck ended, without chuck and
/// bit, as lamps, blowers and hot air tools on a battery have; a template of its own, likewise.
/// nullopt for a kind without a chuck that lies along x.
std::optional<DrillTemplate> WithoutChuck(const DrillTemplate& kind);

/// What a cordless hot air or glue tool has in place of a chuck: a nozzle longer than any chuck,
/// which a fit explains by a chuck and a bit, or by a longer head. The drill's parts with a nozzle
/// in place of chuck and bit, in each way it may lie: up to the chuck's face or the bit's tip, as
/// thick as the chuck or thinner; the head ends where the nozzle begins. Empty for a drill without
/// a chuck. @pre nozzle_m > 0
std::vector<std::vector<SolidPart>> WithNozzles(const std::vector<SolidPart>& drill,
                                                double nozzle_m);

}  // namespace foresight
