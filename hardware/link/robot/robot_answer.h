#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"
#include "hardware/api/robot_answer.h"

namespace foresight {

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
