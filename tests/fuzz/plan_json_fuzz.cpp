// Scan plans in a mission file.
#include <cstdint>
#include <string>

#include "core/mission/plan_json.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace foresight;
  const auto plan = PlanFromJson({reinterpret_cast<const char*>(bytes), size}, "fuzz");
  if (!plan) return 0;
  const auto again = PlanFromJson(PlanToJson(*plan), "fuzz");
  Require(again.has_value() && *again == *plan, "a plan survives the round trip");
  return 0;
}
