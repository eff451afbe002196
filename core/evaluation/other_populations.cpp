#include "core/evaluation/other_populations.h"

#include "core/evaluation/other_drill_scene.h"
#include "core/evaluation/other_handle_scene.h"
#include "core/evaluation/other_terrain_scene.h"
#include "core/evaluation/other_valve_scene.h"

namespace foresight {

FitTrialScene OtherValvePopulation::MakeScene(std::uint64_t seed) const {
  return OtherValveScene(seed);
}

FitTrialScene OtherDrillPopulation::MakeScene(std::uint64_t seed) const {
  return OtherDrillScene(seed);
}

FitTrialScene OtherTerrainPopulation::MakeScene(std::uint64_t seed) const {
  return OtherTerrainScene(seed);
}

FitTrialScene OtherHandlePopulation::MakeScene(std::uint64_t seed) const {
  return OtherHandleScene(seed);
}

}  // namespace foresight
