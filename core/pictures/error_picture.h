#pragma once

#include "core/pictures/legend.h"

namespace foresight {

/// How far a depth map is from the truth, as in Fig. 7, but absolute: |depth - truth| in turbo from
/// 0 to `full_scale_m`, larger ones in its last colour. Pixels without a truth are light grey,
/// pixels that the mask drops or that have no depth almost black; no colour of the map is either.
/// `mask` may be null: nothing is masked. All images have one size.
ColorImage PaintError(const DepthImage& depth_m, const MaskImage* mask, const DepthImage& truth_m,
                      double full_scale_m);

/// What PaintError's colours mean, millimetres.
PictureLegend LegendOfError(double full_scale_m);

}  // namespace foresight
