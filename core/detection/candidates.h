#pragma once

#include <optional>
#include <string>

#include "core/detection/detection.h"
#include "core/objects/solid_part.h"

namespace foresight {

/// What an operator steps through: the best answer (0) and its alternatives (a cylinder has none),
/// or a terrain's surfaces. At least 1, but for a terrain without a surface.
int CandidateCount(const Detection& detection);

/// Of the candidate, in base; the index is brought into its range. The identity where there is
/// none.
Rigid<frame::Base, frame::Object> CandidatePose(const Detection& detection, int candidate);

/// By how much an alternative is less likely than the best answer, in nats; nullopt for the best
/// answer, a cylinder, and a terrain, whose surfaces are no alternatives to each other.
std::optional<double> MarginBehindBest(const Detection& detection, int candidate);
/// MarginWords in the operator's language.
std::string MarginInWords(double nats);

/// What an operator may make of it: an alternative is LIKELY at most, and that only where it is
/// about as likely as the best answer; one that is clearly behind is UNSURE, whatever the best one
/// is.
VerdictLevel CandidateLevel(const Detection& detection, int candidate);

/// A cylinder as the solid that it is.
SolidPart PartOf(const CylinderModel& model);

/// What it is, and by how much an alternative is worse: "4 spokes, rim 240 mm across", "alternative
/// 1 of 2: 3 spokes, rim 236 mm across, clearly less likely".
std::string CandidateText(const Detection& detection, int candidate);

}  // namespace foresight
