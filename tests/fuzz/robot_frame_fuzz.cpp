// Samples for the robot's frame.
#include <cstdint>

#include "core/calibration/robot_frame.h"
#include "tests/fuzz/session_files.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace foresight;
  static SessionFiles files;
  files.Write("robot.yaml", {reinterpret_cast<const char*>(bytes), size});
  const auto samples = ReadRobotFrameSamples(files.path() / "robot.yaml", RigOfFewBeams(), {});
  if (!samples) {
    Require(!samples.error().message.empty(), "an error has a message");
    return 0;
  }
  const auto found = CalibrateRobotFrame(*samples, {});
  if (!found) return 0;
  Require(found->found.robot_from_base.translation().allFinite(), "a place is finite");
  Require(found->found.covariance.allFinite(), "a covariance is finite");
  return 0;
}
