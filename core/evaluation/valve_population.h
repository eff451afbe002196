#pragma once

#include "core/evaluation/fit_trial.h"

namespace foresight {

/// Valves as they are built and the things that resemble them, docs/evaluation/valve.md "Valve
/// fit".
///
/// Positives: wheels of 2 to 6 spokes or a disc, rims of 95 to 240 mm radius and some down to 45
/// mm, seen up to 40 deg off their axis, and levers; on a stem with a flange before a wall, often
/// beside a pipe, some not parallel to the wall; 0.7 to 2 m away, some to 3 m (then `what` ends
/// with "beyond 2 m"); range noise of 4 to 20 mm, lines 0.25 to 1 deg apart. Half of the wheels
/// with spokes are round in section, the others are made otherwise (varied_wheel.h: cast, cut from
/// a plate, rolled from a bar, pressed; `what` begins with that). Negatives: an empty wall or
/// region, a box, a ball, a pipe, half a wheel, a coil of cable, a table's edge, a bicycle's wheel,
/// a square frame with a cross; and, half of them, things made like such wheels: a ring, a cross
/// without a rim, a wheel that lacks a spoke, half a wheel.
///
/// The pose is right where the centre is within 20 mm, the axis within 5 deg and the radius within
/// 12 mm (a lever's length within 20 mm); everything is, where also the number of spokes is and the
/// phase is within 6 deg (a disc has none, a lever's is the direction of x). Errors: "center_mm",
/// "axis_deg", "radius_mm", "phase_deg", "spokes" (0 = right, 1 = wrong).
class ValvePopulation : public FitPopulation {
 public:
  ObjectKind Kind() const override { return ObjectKind::kValve; }
  FitTrialScene MakeScene(std::uint64_t seed) const override;
  std::vector<FitOutcome> Judge(const FitTrial& trial,
                                const Result<Detection>& found) const override;
  std::vector<std::string> FeatureNames() const override;
};

}  // namespace foresight
