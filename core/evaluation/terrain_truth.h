#pragma once

#include <span>
#include <vector>

#include "core/evaluation/fit_trial.h"

namespace foresight {

/// A block of a scene and how it can be seen in a trial.
struct TrueBlock {
  Rigid<frame::Base, frame::Object> base_from_object;
  Eigen::Vector2d size_m = Eigen::Vector2d::Zero();
  /// Fraction of its top that lidar and camera see, inside the region.
  double seen = 0.0;

  bool Visible() const { return seen > 0.6; }
};

/// All blocks of the trial's scene; what can be seen is found by casting rays.
std::vector<TrueBlock> TrueBlocksOf(const FitTrial& trial);

/// The answers to a scene with these blocks, judged; TerrainPopulation has the rules.
std::vector<FitOutcome> JudgeTerrain(std::span<const TrueBlock> blocks,
                                     const Result<TerrainDetection>& found);

}  // namespace foresight
