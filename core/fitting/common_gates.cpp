#include "core/fitting/common_gates.h"

#include <algorithm>

#include "core/fitting/compressed_nats.h"
#include "core/fitting/region_place.h"

namespace foresight {

Gate MeasurementsGate(const std::string& object, double measurements, double least) {
  return {.what = "{} measurements lie on " + object,
          .number = measurements,
          .limit = least,
          .advice = "scan slower or move closer"};
}

Gate SeeThroughGate(const std::string& object, double fraction, double most) {
  return {.what = "{} of the beams went through " + object,
          .unit = Gate::Unit::kFraction,
          .number = fraction,
          .side = Gate::Side::kAtMost,
          .limit = most};
}

Gate AgreementGate(const std::string& object, double fraction, double least) {
  return {.what = "{} of the beams on " + object + " agree with it",
          .unit = Gate::Unit::kFraction,
          .number = fraction,
          .limit = least};
}

double BelowLikely(double probability) {
  return std::min(probability, Verdict::kLikely - 0.01);
}

Gate AlternativeGate(const std::string& alternative, double ahead_nats, double least_nats) {
  return {.what = "the odds against a " + alternative + " in its place are {}",
          .unit = Gate::Unit::kOdds,
          .number = ahead_nats,
          .limit = least_nats};
}

double UsualNatsOf(const VerdictModel& model, std::string_view feature) {
  return std::min(kFarBehind_nats, Expanded(MeanOf(model, feature)));
}

Gate OffCenterGate(const std::string& object, const RaySet& region, const Eigen::Vector3d& middle) {
  return {.what = object + " lies {} from the region's centre",
          .unit = Gate::Unit::kLength,
          .number = DistanceFromRegionCenter(region, middle),
          .side = Gate::Side::kAtMost,
          .limit = kMaxOffCenter_m,
          .advice = "draw the region around it"};
}

void AddIfOutside(Gate gate, double least, double most, std::vector<std::string>& failed_gates) {
  gate.side = Gate::Side::kAtLeast;
  gate.limit = least;
  AddIfFailed(gate, failed_gates);
  gate.side = Gate::Side::kAtMost;
  gate.limit = most;
  AddIfFailed(gate, failed_gates);
}

}  // namespace foresight
