#pragma once

#include <string>

#include "core/mission/pose_message.h"

namespace foresight {

/// A pose that a head with this rig sends on: live, accepted, the best answer, of scan "scan-1".
inline PoseMessage SamplePose() {
  PoseMessage message;
  message.detection_uuid = "6f9619ff-8b86-4d01-b42d-00cf4fc964ff";
  message.sending = 3;
  message.parameters = ValveParameters{};
  message.frame = PoseMessage::Frame::kRobot;
  message.position_m = {1.0 / 3.0, -0.2, 1.3};
  message.rotation = Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5);
  message.covariance = PoseCovariance::Identity() * 1e-6;
  message.verdict = VerdictLevel::kConfirmed;
  message.probability = 0.97;
  message.decision = Decision::kAccepted;
  message.decided_by = "ann";
  message.origin = PoseMessage::Origin::kLive;
  message.scan_uuid = "scan-1";
  message.scan_begin_utc_ns = 1'700'000'000'123'456'789;
  message.rig_id = std::string(64, 'a');
  message.age_s = 12.5;
  return message;
}

}  // namespace foresight
