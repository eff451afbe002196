#pragma once

#include "core/pictures/projected_wireframe.h"
#include "ui/viewmodels/session_model.h"

namespace foresight {

/// The templates of all valves found in the current scan, in pixels of the current picture.
PixelLines TemplatesInPicture(const SessionModel& session);

/// The same in the robot's frame.
Wireframe TemplatesInRobot(const SessionModel& session);

}  // namespace foresight
