#pragma once

#include <string>
#include <string_view>

#include "core/mission/pose_message.h"

namespace foresight {

/// The version of the form; who changes what a member means raises it.
inline constexpr int kPoseMessageVersion = 1;
/// No message is longer.
inline constexpr std::size_t kLongestPoseMessage_bytes = 16'384;

/// One line of JSON without a line feed, docs/protocols.md. A value that is not finite becomes
/// null, which no reader takes.
std::string PoseMessageToJson(const PoseMessage& message);
/// The reverse; every member is checked (CheckPoseMessage), and members that are not known are
/// ignored. Fails with kBadData, naming the member at fault.
Result<PoseMessage> PoseMessageFromJson(std::string_view json);

}  // namespace foresight
