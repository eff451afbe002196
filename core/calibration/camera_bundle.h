#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/calibration/board_pose.h"

namespace foresight {

/// A camera, a board and where the board was in each image: what a calibration of a camera
/// estimates, with what it estimates that from.
struct CameraBundle {
  CalibrationBoard board;
  std::vector<BoardView> views;
  CameraModel camera;
  BoardWarp warp;
  std::vector<CameraFromPattern> poses;  ///< of the board, one a view

  int CornerCount() const;
};

struct BundleOptions {
  bool free_lens = true;
  bool free_principal_point = true;
  bool free_warp = false;
  /// Cauchy's loss: a corner that is this far off counts half as much. 0 = least squares.
  double loss_px = 0.0;
  int max_iterations = 100;
};

/// Moves camera, warp and poses to the least sum of squared distances in the image. Fails with
/// kNoConvergence, also where a corner leaves the lens's domain at the start; with kCancelled.
Status AdjustBundle(CameraBundle& bundle, const BundleOptions& options, const RunContext& context);

/// Where the model has each corner minus where it was found, px; NaN where the lens does not show
/// it.
std::vector<Eigen::Vector2d> ViewErrors(const CameraBundle& bundle, std::size_t view);

/// Of all corners of some views.
struct ErrorSummary {
  double mean_px = 0.0;  ///< mean of the distances |e|, the paper's "mean projection error"
  double rms_px = 0.0;   ///< root of the mean of |e|^2, as OpenCV and mrcal report it
  int corners = 0;
};
ErrorSummary SummarizeErrors(const std::vector<Eigen::Vector2d>& errors);
ErrorSummary SummarizeErrors(const CameraBundle& bundle);

}  // namespace foresight
