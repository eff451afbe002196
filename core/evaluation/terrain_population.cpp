#include "core/evaluation/terrain_population.h"

#include "core/evaluation/terrain_scene.h"
#include "core/evaluation/terrain_truth.h"
#include "core/fitting/terrain/fit_terrain.h"
#include "core/fitting/terrain/terrain_verdict.h"

namespace foresight {

FitTrialScene TerrainPopulation::MakeScene(std::uint64_t seed) const {
  return RandomTerrainScene(seed);
}

FitOptions TerrainPopulation::Options(const SensorRig& rig) const {
  FitOptions options = FitPopulation::Options(rig);
  std::get<FitTerrainOptions>(options).graph_cut = graph_cut_;
  return options;
}

std::vector<FitOutcome> TerrainPopulation::Judge(const FitTrial& trial,
                                                 const Result<Detection>& found) const {
  const std::vector<TrueBlock> blocks = TrueBlocksOf(trial);
  if (!found) return JudgeTerrain(blocks, tl::unexpected(found.error()));
  return JudgeTerrain(blocks, std::get<TerrainDetection>(*found));
}

std::vector<std::string> TerrainPopulation::FeatureNames() const {
  return TerrainFeatureNames();
}

}  // namespace foresight
