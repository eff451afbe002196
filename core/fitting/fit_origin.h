#pragma once

#include <Eigen/Core>
#include <string>

#include "core/fitting/roi.h"

namespace foresight {

/// Where an answer comes from, so that it can be asked for again.
struct FitOrigin {
  Roi roi;                     ///< where it was looked for
  std::string source = "raw";  ///< "raw" = lidar returns, else the depth method's name
  bool image = false;          ///< the scan's image was looked at beside it
  double seconds = 0.0;        ///< the fit took
};

/// Of a pose: a small move in metres, then a small turn in radians, both about the object's own
/// axes. NaN = not known.
using PoseCovariance = Eigen::Matrix<double, 6, 6>;

}  // namespace foresight
