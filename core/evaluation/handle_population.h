#pragma once

#include "core/evaluation/fit_trial.h"

namespace foresight {

/// Doors with lever handles, and with what resembles them, docs/evaluation/handle.md "Door handle
/// fit".
///
/// Positives: levers of 85 to 165 mm (mostly 95 to 145), of round, flat and oval section, straight,
/// bowed or lifted, some tapered, a third with an end that is bent back, on rosettes and long
/// plates, often over a lock; level and to either side, one in eight turned up to 90 deg; on a leaf
/// in its frame in a wall, 0.85 to 1.15 m high and 0.55 to 1.5 m ahead, seen up to 40 deg from the
/// side; range noise of 4 to 20 mm, lines 0.2 to 0.7 deg apart. Negatives: a bare door, knobs, pull
/// bars and bows with two posts, bars on one, thumb turns, bare locks, cables, brackets, switch
/// boxes, pipes, hooks, hinges, bolts. Which is which is measured on what was drawn
/// (DoorThingMeasures).
///
/// The pose is right where the pivot is within 20 mm, the lever's direction within 10 deg and the
/// door's normal within 5 deg; everything is, where the pivot is within 15 mm, the direction within
/// 8 deg and the length within 20 mm as well: a gripper that opens 85 mm finds the lever between
/// its fingers at two thirds of its length, and turns it about the right axis
/// (docs/evaluation/handle.md, "Door handle fit"). Errors: "pivot_mm", "direction_deg",
/// "normal_deg", "length_mm", "flip" (1 = it points the other way, by more than 90 deg).
class HandlePopulation : public FitPopulation {
 public:
  ObjectKind Kind() const override { return ObjectKind::kHandle; }
  FitTrialScene MakeScene(std::uint64_t seed) const override;
  std::vector<FitOutcome> Judge(const FitTrial& trial,
                                const Result<Detection>& found) const override;
  std::vector<std::string> FeatureNames() const override;
};

}  // namespace foresight
