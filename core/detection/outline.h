#pragma once

#include <vector>

#include "core/detection/detection.h"
#include "core/objects/solid_part.h"

namespace foresight {

/// One thing to draw of a detection, and how sure it is. A view draws CONFIRMED solid, LIKELY
/// dashed and UNSURE as a thin grey line: a state is never told by colour alone.
struct Outline {
  Wireframe lines;  ///< in base, metres
  VerdictLevel level = VerdictLevel::kUnsure;
  bool chosen = false;  ///< the candidate that the operator looks at
};

/// The candidate's template; of a terrain all surfaces, each with its toehold as a second rectangle
/// inside. Nothing for a terrain without a surface.
std::vector<Outline> OutlinesOf(const Detection& detection, int candidate);

/// The lines cut into dashes, metres along each line.
Wireframe Dashed(const Wireframe& lines, double dash_m, double gap_m);
/// A dash that suits what the lines enclose: a fortieth of its diagonal.
Wireframe Dashed(const Wireframe& lines);

}  // namespace foresight
