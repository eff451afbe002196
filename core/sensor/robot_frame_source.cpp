#include "core/sensor/robot_frame_source.h"

namespace foresight {

std::string_view ToString(RobotFrameSource source) {
  switch (source) {
    case RobotFrameSource::kCad:
      return "cad";
    case RobotFrameSource::kHandEye:
      return "hand_eye";
    case RobotFrameSource::kSurveyedBoards:
      return "surveyed_boards";
    case RobotFrameSource::kUnknown:
      break;
  }
  return "";
}

}  // namespace foresight
