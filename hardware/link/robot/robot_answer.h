#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"

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

/// A line from the robot: {"id": ..., "answer": "accepted" | "refused", "reason": ...}.
struct RobotLine {
  std::string id;  ///< of the message that it answers
  RobotAnswer answer;
};
/// Longer lines, and longer reasons, are refused.
inline constexpr std::size_t kLongestRobotLine_bytes = 4096;
inline constexpr std::size_t kLongestReason_bytes = 500;
/// Fails with kBadData, naming the member at fault.
Result<RobotLine> RobotLineFromJson(std::string_view json);

}  // namespace foresight
