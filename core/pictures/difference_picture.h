#pragma once

#include "core/depth/compare_depth.h"
#include "core/pictures/legend.h"
#include "core/pictures/line_chart.h"

namespace foresight {

/// The difference of two depth maps: blue where the second is nearer, white where they agree,
/// orange where it is further away, full colour at DepthComparison::kFullScale_m. A pixel that only
/// the first keeps is violet, one of the second alone green, one of neither almost black;
/// no colour of the map is any of these.
ColorImage PaintDifference(const DepthComparison& comparison, const DepthImage& first_m,
                           const MaskImage& first_mask, const DepthImage& second_m,
                           const MaskImage& second_mask);

/// What the colours mean, millimetres, in a picture of its own or below another one.
PictureLegend LegendOfDifference(const std::string& first, const std::string& second);

/// The colours of pixels that one of the two keeps.
extern const Rgb8 kColorOnlyInA;
extern const Rgb8 kColorOnlyInB;

/// Pixels by their difference, in percent of those that both keep.
LineChart ChartOfDifference(const DepthComparison& comparison);

}  // namespace foresight
