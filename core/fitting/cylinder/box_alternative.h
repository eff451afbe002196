#pragma once

#include "core/fitting/cylinder/cylinder_state.h"

namespace foresight {

inline constexpr int kBoxAlternativeParameters = 9;

/// Log likelihood of the best box that stands where a cylinder does: a post may be square.
double BestBoxScore(const CylinderState& cylinder, const BeamLikelihood& likelihood);

}  // namespace foresight
