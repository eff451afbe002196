#pragma once

#include <memory>

#include "hardware/api/sensor_head.h"
#include "hardware/assembly/head_config.h"
#include "hardware/head/head_devices.h"

namespace foresight {

/// The drivers of a head's devices; nothing is connected yet. `clock` runs in real time.
HeadDevices MakeDrivers(const HeadConfig& config, std::shared_ptr<SensorClock> clock);

/// A complete head on real devices. Nothing is connected or moved until Home(). A configuration
/// that was loaded from a file passes; throws ContractViolation for one that does not.
std::unique_ptr<SensorHead> MakeRealHead(const HeadConfig& config);

}  // namespace foresight
