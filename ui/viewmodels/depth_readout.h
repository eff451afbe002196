#pragma once

#include <QString>

#include "core/depth/pipeline.h"

namespace foresight {

/// Which map is asked about, and how it was made.
struct ReadoutSource {
  const DepthResult& result;
  const DepthImage& depth_m;  ///< the map that is shown: the final one or one of the passes
  double threshold;           ///< below this fraction of the largest confidence a pixel is masked
  double radius_px;           ///< how far a pixel looks for samples; 0 = not known
};

/// What is known about a pixel of the depth map.
struct DepthReadout {
  int x = 0;
  int y = 0;
  double depth_mm = 0.0;    ///< NaN = none
  double confidence = 0.0;  ///< of the largest in the map
  bool relative = true;     ///< false for a method whose confidence is absolute: its largest is 1
  bool has_confidence = true;  ///< else `confidence` means nothing
  bool masked = false;         ///< has a depth that is not to be trusted
  bool sparse = false;  ///< of a map below the density floor, where no depth is to be trusted
  QString reason;       ///< why it is masked or empty, in words; else empty
};

/// Radius of the window that a pixel's depth is made from; 0 for methods that know none.
double SearchRadius(const DepthResult& result, const DepthOptions& made_with);

/// Looks at one pixel, which must lie in the map, and explains it. O(samples).
DepthReadout ReadDepth(const ReadoutSource& source, int x, int y);

/// What speaks against the map as a whole: its density is below the paper's floor. Else empty.
QString DensityWarning(const DepthResult& result);

/// The readout in one line: "(412, 233)  1842 mm  confidence 0.21: ...".
QString TextOf(const DepthReadout& readout);

}  // namespace foresight
