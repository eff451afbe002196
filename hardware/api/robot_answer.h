#pragma once

#include <string>

namespace foresight {

/// What became of a pose that was to reach the robot.
struct RobotAnswer {
  enum class Kind {
    kAccepted,
    kRefused,      ///< by the robot or, before it, by the head
    kNoAnswer,     ///< the robot may have got it
    kNobodyThere,  ///< no robot is connected; it got nothing
  };
  Kind kind = Kind::kNobodyThere;
  std::string reason;  ///< a sentence; empty where it was accepted without a remark

  bool operator==(const RobotAnswer&) const = default;
};
/// "accepted", "refused", "no_answer", "nobody_there".
const char* ToString(RobotAnswer::Kind kind);

}  // namespace foresight
