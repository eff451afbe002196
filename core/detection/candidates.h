#pragma once

#include <string>

#include "core/detection/detection.h"

namespace foresight {

/// What an operator steps through: the best answer (0) and its rivals, or a terrain's surfaces. At
/// least 1, but for a terrain without a surface.
int CandidateCount(const Detection& detection);

/// Of the candidate, in base; the index is brought into its range. The identity where there is
/// none.
Rigid<frame::Base, frame::Object> CandidatePose(const Detection& detection, int candidate);

/// What an operator may make of it: a rival is never more than LIKELY.
VerdictLevel CandidateLevel(const Detection& detection, int candidate);

/// What it is, and by how much a rival is worse: "4 spokes, rim 240 mm across", "rival 1 of 2: 3
/// spokes, rim 236 mm across, clearly less likely (38 nats)".
std::string CandidateText(const Detection& detection, int candidate);

}  // namespace foresight
