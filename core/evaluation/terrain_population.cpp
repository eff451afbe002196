#include "core/evaluation/terrain_population.h"

#include "core/evaluation/terrain_scene.h"
#include "core/evaluation/terrain_truth.h"
#include "core/fitting/terrain/fit_terrain.h"
#include "core/fitting/terrain/terrain_verdict.h"

namespace foresight {

FitTrialScene TerrainPopulation::MakeScene(std::uint64_t seed) const {
  return RandomTerrainScene(seed);
}

Result<Detection> TerrainPopulation::Fit(const ProcessedScan& scan, FitSource source,
                                         const Roi& roi, const RunContext& context) const {
  FitTerrainOptions options;
  options.up = scan.rig.robot_from_base.Inverse().Rotate(Eigen::Vector3d::UnitZ());
  options.graph_cut = graph_cut_;
  FORESIGHT_TRY(const RaySet rays, RaysInScan(scan, source, roi));
  FORESIGHT_TRY(TerrainDetection terrain, FitTerrain(rays, options, nullptr, context));
  return Detection(std::move(terrain));
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
