#pragma once

#include <string_view>

namespace foresight {

/// Where robot_from_base comes from.
enum class RobotFrameSource { kUnknown, kCad, kHandEye, kSurveyedBoards };

/// "cad", "hand_eye", "surveyed_boards", as rig files have it; "" where it is not known.
std::string_view ToString(RobotFrameSource source);

}  // namespace foresight
