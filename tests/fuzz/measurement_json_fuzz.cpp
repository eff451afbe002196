// Measurements out of a mission.
#include <cstdint>

#include "core/measure/measurement_json.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace foresight;
  const auto measured = MeasurementFromJson({reinterpret_cast<const char*>(bytes), size});
  if (!measured) {
    Require(!measured.error().message.empty(), "an error says what");
    return 0;
  }
  Require(!ValueText(*measured).empty() && !MeasurementLines(*measured).empty(), "it can be drawn");
  const std::string json = MeasurementToJson(*measured);
  const auto again = MeasurementFromJson(json);
  Require(again.has_value() && MeasurementToJson(*again) == json, "and survives the round trip");
  return 0;
}
