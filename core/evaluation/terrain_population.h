#pragma once

#include "core/evaluation/fit_trial.h"

namespace foresight {

/// Fields of cinder blocks and what resembles them, docs/evaluation/terrain.md "Terrain fit".
///
/// Positives: 3 x (3 to 5) blocks, tilted by 15 deg in four directions, 15 % flat, on layers of 0,
/// 0.19 and 0.38 m, each up to 8 mm and 1.5 deg off its place, or, one in six, 2 to 6 blocks that
/// stand in no rows; head 1.1 to 1.6 m above rough
/// ground, range noise of 4 to 20 mm, lines 0.25 to 1 deg apart. Negatives: flat ground, stairs,
/// boxes of other sizes, a ramp, rubble, a table's edge, a wall.
///
/// A block is in view where lidar and camera see more than 60 % of its top inside the region. A
/// surface offered as a block matches a block (its pose is right) where its centre is within 50 mm
/// and its normal within 5 deg, and is right in every respect within 25 mm and 2.5 deg. One outcome
/// a surface offered, one a block in view that is missed, at least one a scene. Errors:
/// "center_mm", "tilt_deg", "yaw_deg" (up to quarter turns), "height_mm" (along the normal),
/// "toehold_iou", "false_area" (fraction of the toehold with no block under it), "in_view" (1 =
/// found a block that is in view).
class TerrainPopulation : public FitPopulation {
 public:
  /// `graph_cut`: false to measure what it is worth.
  explicit TerrainPopulation(bool graph_cut = true) : graph_cut_(graph_cut) {}

  ObjectKind Kind() const override { return ObjectKind::kTerrain; }
  FitTrialScene MakeScene(std::uint64_t seed) const override;
  FitOptions Options(const SensorRig& rig) const override;
  std::vector<FitOutcome> Judge(const FitTrial& trial,
                                const Result<Detection>& found) const override;
  std::vector<std::string> FeatureNames() const override;

 private:
  bool graph_cut_;
};

}  // namespace foresight
