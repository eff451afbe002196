// Plans of what goes wrong with emulated devices.
#include <cstdint>
#include <string>

#include "hardware/emulator/device_faults.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace foresight;
  const auto faults =
      DeviceFaultsFromYaml({reinterpret_cast<const char*>(bytes), size}, "fuzz.yaml", 1);
  if (!faults) return 0;
  Require(faults->lidar.Check().has_value() && faults->camera.Check().has_value(),
          "a plan that was accepted is usable");
  for (const MotorFault& fault : faults->motor)
    Require(fault.after_s >= 0.0 && fault.duration_s >= 0.0, "a fault has its time");
  return 0;
}
