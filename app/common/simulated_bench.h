#pragma once

#include <memory>
#include <string>

#include "core/simulation/world.h"
#include "hardware/api/sensor_head.h"

namespace foresight {

/// How to set up a head on a simulated scene.
struct SimulationArguments {
  std::string scene;
  std::string rig;  ///< the true head; empty = the built-in one
  std::uint64_t seed = 1;
  bool real_time = false;
};

/// The scene with a head in it, whose calibration is as good as the paper's procedure can make it.
struct SimulatedBench {
  std::shared_ptr<const World> world;
  std::unique_ptr<SensorHead> head;
};
Result<SimulatedBench> SetUpBench(const SimulationArguments& arguments);

}  // namespace foresight
