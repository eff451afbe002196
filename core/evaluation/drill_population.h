#pragma once

#include "core/evaluation/fit_trial.h"

namespace foresight {

/// Cordless drills as they stand on tables and what resembles them, docs/evaluation/drill.md "Drill
/// fit".
///
/// Positives: drills with every size about a tenth off the templates', a quarter with a boxy head,
/// a quarter leaning 4 to 12 deg on a smaller foot, with thick grips, side handles, bits of 0 to
/// 120 mm, and some upright cut-out tools; turned any way on a table, often before a wall and
/// beside other things; 0.7 to 2 m away, some to 2.5 m (then `what` ends with "beyond 2 m"), seen 5
/// to 40 deg from above; range noise of 4 to 20 mm, lines 0.25 to 1 deg apart. Negatives: an empty
/// table, its edge, a wall, boxes, bottles, a box beside or on a cylinder, a lamp, a mug, a spray
/// can, and a region that shows only a drill's foot or end.
///
/// The pose is right where the body's axis passes within 30 mm of the true one at the grip's middle
/// and the bit points within 20 deg; everything is, where these are 25 mm and 15 deg and the axis
/// stands within 10 deg. Errors: "xy_mm", "yaw_deg", "axis_deg", "flip" (1 = it points the other
/// way, by more than 90 deg); "lean_sigmas", of the axis in the plane of the bit.
class DrillPopulation : public FitPopulation {
 public:
  ObjectKind Kind() const override { return ObjectKind::kDrill; }
  FitTrialScene MakeScene(std::uint64_t seed) const override;
  std::vector<FitOutcome> Judge(const FitTrial& trial,
                                const Result<Detection>& found) const override;
  std::vector<std::string> FeatureNames() const override;
};

}  // namespace foresight
