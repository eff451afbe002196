#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hardware/emulator/camera_faults.h"
#include "hardware/emulator/lidar_faults.h"
#include "hardware/emulator/motor_faults.h"

namespace foresight {

/// What goes wrong with the three devices of an emulated head.
struct DeviceFaults {
  LidarFaults lidar;
  std::vector<MotorFault> motor;
  CameraFaults camera;
};

/// A fault plan, docs/formats.md. `seed` decides whatever the file leaves to chance. Fails with
/// kBadData, naming `source`, the line and the key.
Result<DeviceFaults> DeviceFaultsFromYaml(const std::string& yaml, const std::string& source,
                                          std::uint64_t seed);
/// The same from a file; also fails with kIo.
Result<DeviceFaults> LoadDeviceFaults(const std::filesystem::path& path, std::uint64_t seed);

}  // namespace foresight
