#pragma once

#include <string>
#include <vector>

#include "core/fitting/beam_likelihood.h"
#include "core/fitting/drill/drill_state.h"

namespace foresight {

/// Something simple that stands on a table, as large as it likes.
struct AlternativeShape {
  std::string name;              ///< "box", "cylinder", "box and cylinder"
  std::vector<SolidPart> parts;  ///< in the table's frame
  int parameters = 0;
  double log_likelihood = 0.0;
};

/// The best free box, upright cylinder, and both together (side by side or stacked) near a place of
/// the table, the best first. `foreground` in base.
std::vector<AlternativeShape> FitAlternativeShapes(const BeamLikelihood& likelihood,
                                                   const std::vector<Eigen::Vector3d>& foreground,
                                                   const TableFrame& base_from_table,
                                                   const Eigen::Vector2d& place);

}  // namespace foresight
