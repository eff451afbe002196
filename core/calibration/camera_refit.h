#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/calibration/lens_model.h"

namespace foresight {

/// A camera in the words of another model, and how well that says the same.
struct CameraRefit {
  CameraModel camera;
  double max_error_px = 0.0;  ///< largest distance in the image between the two for one ray
  Eigen::Vector2d max_at = Eigen::Vector2d::Zero();  ///< the pixel where that is
  double rms_error_px = 0.0;
  /// Of the pixels asked for, those whose ray only the first camera has; the errors leave them out.
  int not_shown = 0;
};

/// The camera of another model that shows the rays of `pixels` nearest to where `camera` has them,
/// least squares. The principal point moves too, the image's size stays. Fails with kTooFewPoints
/// where less than half of the pixels have a ray in both, with kNoConvergence.
Result<CameraRefit> RefitCamera(const CameraModel& camera, LensModel model,
                                const std::vector<Eigen::Vector2d>& pixels);

/// Pixels from edge to edge of the image, `across` in a row, those with a ray.
std::vector<Eigen::Vector2d> PixelGrid(const CameraModel& camera, int across = 40);

}  // namespace foresight
