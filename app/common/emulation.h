#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>

#include "hardware/assembly/head_config.h"
#include "hardware/emulator/emulated_devices.h"

namespace foresight {

/// How to set up emulated devices, as the command line says it.
struct EmulationArguments {
  std::string scene;
  std::string rig;  ///< the true head; empty = the built-in one
  std::uint64_t seed = 1;
  std::string lidar;               ///< ADDR:PORT; empty = a free port of this computer
  std::string motor;               ///< the same
  std::string camera;              ///< ADDR; empty = a free address of this computer
  std::string faults;              ///< file of a fault plan; empty = none
  std::optional<int> stand_place;  ///< World::MoveStand; not given: the scene's first
};

/// Adds the options for everything but the scene; they make sense only with `scene`.
void AddEmulationOptions(CLI::App& command, CLI::Option* scene, EmulationArguments& arguments);

Result<std::unique_ptr<EmulatedDevices>> StartEmulation(const EmulationArguments& arguments);

/// The configuration of a head on these devices, as well calibrated as can be.
HeadConfig ConfigFor(EmulatedDevices& devices);

}  // namespace foresight
