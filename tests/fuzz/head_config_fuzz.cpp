// Heads and their devices.
#include <cstdint>
#include <string>

#include "hardware/assembly/head_config.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace foresight;
  const std::string yaml(reinterpret_cast<const char*>(bytes), size);
  // A rig would be a file; it has a fuzzer of its own.
  if (yaml.find("rig") != std::string::npos) return 0;
  const auto config = HeadConfigFromYaml(yaml, "fuzz.yaml", "/nonexistent");
  if (!config) return 0;
  std::string written = HeadConfigToYaml(*config, "");
  written.erase(written.find("rig: \"\"\n"), 8);
  const auto again = HeadConfigFromYaml(written, "again.yaml", "/nonexistent");
  Require(again.has_value(), "a head survives the round trip");
  Require(again->name == config->name && again->lidar.address == config->lidar.address &&
              again->motor.host == config->motor.host &&
              again->camera.address == config->camera.address,
          "names and addresses survive the round trip");
  return 0;
}
