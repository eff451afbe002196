#include "app/common/simulated_bench.h"

#include "hardware/simulated/simulated_head.h"

namespace foresight {

Result<SimulatedBench> SetUpBench(const SimulationArguments& arguments) {
  FORESIGHT_TRY(Scene loaded, LoadScene(arguments.scene));
  const auto scene = std::make_shared<const Scene>(std::move(loaded));
  SimulatedHeadOptions options;
  if (!arguments.rig.empty()) {
    FORESIGHT_TRY(options.true_rig, LoadSensorRig(arguments.rig));
  }
  options.world.seed = arguments.seed;
  options.speed =
      arguments.real_time ? SimulationSpeed::kRealTime : SimulationSpeed::kAsFastAsPossible;
  SimulatedBench bench;
  bench.world = std::make_shared<const World>(scene, options.true_rig, options.world);
  options.believed_rig = options.true_rig;
  options.believed_rig.angle_correction = bench.world->CalibratedCorrection();
  FORESIGHT_TRY(bench.head, MakeSimulatedHead(bench.world, options));
  return bench;
}

}  // namespace foresight
