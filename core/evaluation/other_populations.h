#pragma once

#include "core/evaluation/drill_population.h"
#include "core/evaluation/handle_population.h"
#include "core/evaluation/terrain_population.h"
#include "core/evaluation/valve_population.h"

namespace foresight {

// The scenes of the other world (other_world.h), judged by the rules of our own. THEY JUDGE ONLY:
// nothing may ever be fitted to them or chosen by them, and packaging/refit-verdicts never asks for
// them.

class OtherValvePopulation : public ValvePopulation {
 public:
  FitWorld World() const override { return FitWorld::kOther; }
  FitTrialScene MakeScene(std::uint64_t seed) const override;
};

class OtherDrillPopulation : public DrillPopulation {
 public:
  FitWorld World() const override { return FitWorld::kOther; }
  FitTrialScene MakeScene(std::uint64_t seed) const override;
};

class OtherTerrainPopulation : public TerrainPopulation {
 public:
  FitWorld World() const override { return FitWorld::kOther; }
  FitTrialScene MakeScene(std::uint64_t seed) const override;
};

class OtherHandlePopulation : public HandlePopulation {
 public:
  FitWorld World() const override { return FitWorld::kOther; }
  FitTrialScene MakeScene(std::uint64_t seed) const override;
};

}  // namespace foresight
