#pragma once

#include <filesystem>
#include <memory>

#include "core/simulation/world.h"
#include "hardware/api/sensor_head.h"
#include "hardware/simulated/simulated_clock.h"

namespace foresight {

/// What a simulated head is made of.
struct SimulatedHeadOptions {
  WorldOptions world;
  SensorRig true_rig = DefaultSensorRig();      ///< the head as it is
  SensorRig believed_rig = DefaultSensorRig();  ///< the calibration in force
  SimulationSpeed speed = SimulationSpeed::kRealTime;
  /// CaptureOptions::operator_timeout_s; only in real time, as an operator's seconds are.
  double operator_timeout_s = 5.0;
};

/// A complete head in this process, looking at a scene. Fails with kInvalidOptions for a bad rig,
/// and with the scene's errors for the second form.
Result<std::unique_ptr<SensorHead>> MakeSimulatedHead(std::shared_ptr<const Scene> scene,
                                                      const SimulatedHeadOptions& options);
Result<std::unique_ptr<SensorHead>> MakeSimulatedHead(const std::filesystem::path& scene_file,
                                                      const SimulatedHeadOptions& options);

/// The same in a world that the caller keeps, e.g. to move its stand; the world's rig and options
/// count, not those of `options`.
Result<std::unique_ptr<SensorHead>> MakeSimulatedHead(std::shared_ptr<const World> world,
                                                      const SimulatedHeadOptions& options);

}  // namespace foresight
