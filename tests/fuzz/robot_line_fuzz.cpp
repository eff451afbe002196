// What a robot answers.
#include <cstdint>

#include "core/base/printable.h"
#include "hardware/link/robot/robot_answer.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace foresight;
  const auto line = RobotLineFromJson({reinterpret_cast<const char*>(bytes), size});
  if (!line) {
    Require(!line.error().message.empty(), "an error says what");
    return 0;
  }
  using Kind = RobotAnswer::Kind;
  Require(line->answer.kind == Kind::kAccepted || line->answer.kind == Kind::kRefused,
          "a robot accepts or refuses");
  Require(Printable(line->answer.reason) == line->answer.reason, "a window can show the reason");
  return 0;
}
