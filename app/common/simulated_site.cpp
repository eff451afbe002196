#include "app/common/simulated_site.h"

#include "hardware/simulated/simulated_head.h"

namespace foresight {

Result<SimulatedSite> SetUpSite(const SimulationArguments& arguments) {
  FORESIGHT_TRY(Scene scene, LoadScene(arguments.scene));
  SimulatedHeadOptions options;
  if (!arguments.rig.empty()) {
    FORESIGHT_TRY(options.true_rig, LoadSensorRig(arguments.rig));
  }
  options.world.seed = arguments.seed;
  options.speed =
      arguments.real_time ? SimulationSpeed::kRealTime : SimulationSpeed::kAsFastAsPossible;
  const auto shared = std::make_shared<const Scene>(std::move(scene));
  SimulatedSite site;
  site.world = std::make_shared<const World>(shared, options.true_rig, options.world);
  options.believed_rig = options.true_rig;
  options.believed_rig.angle_correction = site.world->CalibratedCorrection();
  FORESIGHT_TRY(site.head, MakeSimulatedHead(shared, options));
  return site;
}

}  // namespace foresight
