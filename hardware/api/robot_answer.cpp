#include "hardware/api/robot_answer.h"

#include <cstddef>

namespace foresight {

const char* ToString(RobotAnswer::Kind kind) {
  constexpr const char* kNames[] = {"accepted", "refused", "no_answer", "nobody_there"};
  return kNames[static_cast<std::size_t>(kind)];
}

}  // namespace foresight
