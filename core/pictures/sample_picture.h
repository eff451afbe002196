#pragma once

#include "core/depth/aligned_samples.h"
#include "core/pictures/color_map.h"

namespace foresight {

/// The raw samples where the lidar measured: kept ones coloured by depth (turbo), rejected ones in
/// the colour of their reason. Dark background.
ColorImage PaintSamples(const AlignedSamples& samples, const ValueRange& depth_m);

/// Where samples were rejected: kept ones dim grey, rejected ones larger, in front, in the colour
/// of their reason. Dark background.
ColorImage PaintRejections(const AlignedSamples& samples);

/// The colour of a kept sample in PaintRejections.
inline constexpr Rgb8 kKeptSample = {104, 110, 118};

/// The colour that stands for a reason, from the palette of Okabe and Ito.
Rgb8 ColorOf(RejectReason reason);

}  // namespace foresight
