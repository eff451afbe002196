#pragma once

#include <string>
#include <string_view>

#include "core/fitting/gate.h"
#include "core/fitting/ray_set.h"

namespace foresight {

// What is asked of every object, in one wording. `object` is what an operator reads: "the valve",
// "the drill", "it".

/// Of the beams that intersect a confirmed object, those that may end behind it.
inline constexpr double kMaxSeeThrough = 0.15;

/// Independent measurements on the object.
Gate MeasurementsGate(const std::string& object, double measurements, double least);

/// @param fraction of the beams that should have ended on the object, those that went on
Gate SeeThroughGate(const std::string& object, double fraction, double most);

/// @param fraction of the beams on the object, those with a range that agrees
Gate AgreementGate(const std::string& object, double fraction, double least);

/// The probability of an answer where a gate says that there is nothing to speak of: UNSURE.
double BelowLikely(double probability);

/// The odds against something else in the object's place.
/// @param alternative what it may be: "box"
/// @param ahead_nats log likelihood of the object ahead of it
Gate AlternativeGate(const std::string& alternative, double ahead_nats, double least_nats);

/// The limit of a FeatureGate on odds: the feature's mean over the answers that a model was fitted
/// to, in nats, kFarBehind_nats at most. Of a feature that is Compressed nats.
double UsualNatsOf(const VerdictModel& model, std::string_view feature);

/// An operator draws a region round an object: kMaxOffCenter_m.
/// @param middle of the object, in base
Gate OffCenterGate(const std::string& object, const RaySet& region, const Eigen::Vector3d& middle);

/// A gate that keeps a number, as it is told by the gate, above `least` and below `most`: a size at
/// the end of the range that is looked at is no measurement.
void AddIfOutside(Gate gate, double least, double most, std::vector<std::string>& failed_gates);

}  // namespace foresight
