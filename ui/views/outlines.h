#pragma once

#include <vector>

#include "core/pictures/projected_wireframe.h"
#include "ui/viewmodels/session_model.h"

namespace foresight {

/// How an outline is drawn: a verdict's colour, and a pattern that tells it without the colour.
struct OutlineStyle {
  Rgb8 color;
  float width_px = 1.0f;
};

/// Lines of one style. LIKELY is dashed already.
struct PixelOutline {
  PixelLines lines;  ///< in the current image
  OutlineStyle style;
};
struct RobotOutline {
  Wireframe lines;  ///< in robot, metres
  OutlineStyle style;
};

/// All objects of the current scan, each with the candidate that is looked at; of terrain every
/// surface. The selected object is drawn thicker.
std::vector<PixelOutline> OutlinesInImage(const SessionModel& session);
std::vector<RobotOutline> OutlinesInRobot(const SessionModel& session);

/// The session's region: in the current image, and in robot, where only a box is seen.
PixelLines RegionInImage(const SessionModel& session);
Wireframe RegionInRobot(const SessionModel& session);

}  // namespace foresight
