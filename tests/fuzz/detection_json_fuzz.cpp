// Detections in a mission file, and what a window does with one: outlines and facts.
#include <cmath>
#include <cstdint>
#include <string>

#include "core/detection/detection_json.h"
#include "core/detection/facts.h"
#include "core/detection/outline.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace foresight;
  const auto detection = DetectionFromJson({reinterpret_cast<const char*>(bytes), size});
  if (!detection) {
    Require(!detection.error().message.empty(), "an error says what");
    return 0;
  }
  const auto again = DetectionFromJson(DetectionToJson(*detection, {}));
  Require(again.has_value(), "a detection survives the round trip");
  Require(VerdictOf(*again).reason == VerdictOf(*detection).reason &&
              OriginOf(*again).source == OriginOf(*detection).source,
          "and says the same");
  for (const Outline& outline : OutlinesOf(*detection, 0))
    for (const auto& line : outline.lines)
      for (const Eigen::Vector3d& point : line)
        Require(point.allFinite(), "an outline can be drawn");
  (void)FactsOf(*detection, 0, {});
  return 0;
}
