#pragma once

#include <string>
#include <vector>

#include "core/calibration/camera_bundle.h"

namespace foresight {

/// Which part of an image has corners: fractions of its width and height, over all views.
struct CornerCoverage {
  double left = 1.0, right = 0.0;
  double top = 1.0, bottom = 0.0;
};
CornerCoverage CoverageOf(const std::vector<BoardView>& views, int width, int height);

/// Why corners with this coverage cannot calibrate a lens: "all corners lie in the left 45 % of the
/// image"; empty where they can.
std::string CoverageFault(const CornerCoverage& coverage);

/// How boards were held, in words for somebody who has to do better: "no board is tilted by more
/// than 7 deg against the line of sight".
std::string DescribeViews(const CameraBundle& bundle);

/// Largest angle between a board's normal and the line of sight to its middle, rad.
double LargestTilt(const CameraBundle& bundle);

}  // namespace foresight
