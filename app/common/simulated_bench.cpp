#include "app/common/simulated_bench.h"

#include "hardware/simulated/simulated_head.h"

namespace foresight {

Result<SimulatedBench> SetUpBench(const SimulationArguments& arguments) {
  FORESIGHT_TRY(Scene scene, LoadScene(arguments.scene));
  SimulatedHeadOptions options;
  if (!arguments.rig.empty()) {
    FORESIGHT_TRY(options.true_rig, LoadSensorRig(arguments.rig));
  }
  options.world.seed = arguments.seed;
  options.speed =
      arguments.real_time ? SimulationSpeed::kRealTime : SimulationSpeed::kAsFastAsPossible;
  const auto shared = std::make_shared<const Scene>(std::move(scene));
  SimulatedBench bench;
  bench.world = std::make_shared<const World>(shared, options.true_rig, options.world);
  options.believed_rig = options.true_rig;
  options.believed_rig.angle_correction = bench.world->CalibratedCorrection();
  FORESIGHT_TRY(bench.head, MakeSimulatedHead(shared, options));
  return bench;
}

}  // namespace foresight
