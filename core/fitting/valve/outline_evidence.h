#pragma once

#include "core/fitting/solids/image_edges.h"
#include "core/fitting/valve/valve_detection.h"

namespace foresight {

inline constexpr double kLeastOutline_px = 8.0;

/// What an image says of a fitted valve's parts: ValveEvidence::outline_nats_per_px,
/// weakest_outline_nats_per_px and further_outline_nats_per_px. Beams place the valve, to a pixel
/// or two; the image is asked only whether edges lie where rim and spokes (or a lever's bar) end.
/// A part that shows less than kLeastOutline_px of its outline is not asked for.
void AddEvidenceOfOutline(const ImageEdges& image, const ValveCandidate& valve,
                          ValveEvidence& evidence);

/// How much an image's edges speak for a valve with these parts against none, moved together by
/// what rig and fit may be off: nats, as ImageEdges counts them.
double NatsOfOutline(const ImageEdges& image, const ValveCandidate& valve);

}  // namespace foresight
