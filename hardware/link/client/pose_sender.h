#pragma once

#include "hardware/api/robot_answer.h"
#include "hardware/link/client/link_session.h"

namespace foresight {

/// Sends a pose to the robot by way of the head and waits for the robot's answer. While the link is
/// lost the same line is sent again until the head answers, for some seconds; a line that waited on
/// its way longer than that is not carried out. Fails with kDevice where no answer came: the robot
/// may have the pose.
Result<RobotAnswer> SendPose(LinkSession& session, const std::string& pose_json);

}  // namespace foresight
