#pragma once

#include "core/selfcheck/plate_check.h"
#include "core/selfcheck/turn_check.h"

namespace foresight {

/// The check with a drift that it does not see as averages take it: 0, beside the others, and wider
/// than anything that is measured.
template <class Check>
Check WithoutDrift(Check check, typename Check::Unknown unknown) {
  constexpr double kUnseenSigma = 10.0;  // s, rad
  check.drift[unknown] = 0.0;
  check.covariance.row(unknown).setZero();
  check.covariance.col(unknown).setZero();
  check.covariance(unknown, unknown) = kUnseenSigma * kUnseenSigma;
  return check;
}

/// The stamps are seen only where a scan went up and down.
inline PlateCheck WithSeenDrifts(const PlateCheck& plate) {
  return plate.up_and_down ? plate : WithoutDrift(plate, PlateCheck::kStamp);
}

/// The bend is seen only between three images.
inline TurnCheck WithSeenDrifts(const TurnCheck& turns) {
  return turns.bend_seen ? turns : WithoutDrift(turns, TurnCheck::kBend);
}

}  // namespace foresight
