// Calibrations.
#include <cstdint>
#include <string>

#include "core/sensor/sensor_rig.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace foresight;
  const auto rig = SensorRigFromYaml({reinterpret_cast<const char*>(bytes), size}, "fuzz.yaml");
  if (!rig) return 0;
  Require(rig->Check().has_value(), "a rig that was accepted is usable");
  const auto again = SensorRigFromYaml(SensorRigToYaml(*rig), "again.yaml");
  Require(again.has_value(), "a rig survives the round trip");
  Require(again->camera.width == rig->camera.width && again->lidar == rig->lidar,
          "numbers survive the round trip");
  return 0;
}
