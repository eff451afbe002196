#pragma once

#include <vector>

#include "core/calibration/bundle_covariance.h"
#include "core/calibration/intrinsics.h"

namespace foresight {

/// A number in the middle of each cell of a grid over an image; NaN where there is none.
struct ImageField {
  int image_width = 0;
  int image_height = 0;
  int columns = 0;
  int rows = 0;
  std::vector<double> values = {};  ///< row by row

  double At(int column, int row) const {
    return values[static_cast<std::size_t>(row * columns + column)];
  }
  /// The pixel in the middle of a cell.
  Eigen::Vector2d Middle(int column, int row) const;
  /// Of the values that are there; NaN where there is none.
  double Median() const;
  double Largest() const;
};

/// How large the grid of a map is.
struct MapSize {
  int columns = 32;
  int rows = 24;
};

/// How far a point at `distance_m` (infinity is allowed) may appear from where the camera says:
/// one standard deviation in the worst direction, px, as BundleCovariance::OfProjection has it.
ImageField ProjectionUncertainty(const BundleCovariance& covariance, int width, int height,
                                 double distance_m, MapSize size = {});

/// Two cameras of one lens from the images of one board, each from every second image.
struct CameraHalves {
  CameraModel odd;                      ///< from the first, third, ... image
  CameraModel even;                     ///< from the others
  std::vector<Eigen::Vector2d> pixels;  ///< of all corners
};

/// What a model's images were, for whoever calibrates with them again.
CameraBundle BundleOf(const CalibrationBoard& board, const ModelCalibration& model);

/// Fails with kTooFewPoints for fewer than 4 views, with kNoConvergence, and with kCancelled.
Result<CameraHalves> CalibrateHalves(const CameraBundle& bundle, bool free_warp,
                                     const RunContext& context);

/// How far apart the two cameras show what one of them sees in a pixel at `distance_m` (infinity is
/// allowed), px. The frames of the cameras are told from the images too: the turn (and the shift,
/// for a distance) that fits the corners' pixels best is taken out first. NaN where a camera shows
/// nothing.
ImageField DifferenceOfHalves(const CameraHalves& halves, double distance_m, MapSize size = {});

}  // namespace foresight
