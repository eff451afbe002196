// Poses for the robot, as they come over the link.
#include <cstdint>

#include "core/mission/pose_json.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace foresight;
  const auto pose = PoseMessageFromJson({reinterpret_cast<const char*>(bytes), size});
  if (!pose) {
    Require(!pose.error().message.empty(), "an error says what");
    return 0;
  }
  Require(CheckPoseMessage(*pose).has_value(), "what is read is sound");
  const std::string line = PoseMessageToJson(*pose);
  Require(line.find('\n') == std::string::npos, "a pose is one line");
  const auto again = PoseMessageFromJson(line);
  Require(again.has_value() && PoseMessageToJson(*again) == line, "and survives the round trip");
  return 0;
}
