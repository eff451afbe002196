#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/calibration/bundle_covariance.h"
#include "core/calibration/camera_bundle.h"
#include "core/calibration/lens_model.h"

namespace foresight {

/// One image's corners, for calibration.
struct IntrinsicsImage {
  std::string name;  ///< as it is called in results
  BoardView view;
};

struct IntrinsicsOptions {
  /// What is fitted; the best by cross-validation is chosen.
  std::vector<LensModel> models = {LensModel::kFisheyeK, LensModel::kExtendedUnified,
                                   LensModel::kKannalaBrandt};

  /// kAuto: estimated where that predicts images better that were not used.
  enum class Warp { kAuto, kOff, kOn };
  Warp warp = Warp::kAuto;

  /// An image is left out, for all models alike, where the rms of its corners is more than this
  /// many times the images' median, under the Kannala-Brandt lens. 0 = never.
  double image_outlier_ratio = 3.0;
  /// ... and more than this: in a very good set, three times the median is still good.
  double image_outlier_floor_px = 0.5;
  /// A corner is left out where its error is more than this many times the robust standard
  /// deviation of all (1.4826 times the median, per axis), and more than the floor. 0 = never.
  double corner_outlier_ratio = 8.0;
  double corner_outlier_floor_px = 1.5;

  int min_images = 4;
  /// Beyond this relative standard deviation the focal length counts as not observed.
  double largest_focal_sigma = 0.02;
  /// Beyond this rms the model does not describe the images.
  double largest_rms_px = 2.0;

  Status Check() const;
};

/// Errors of one image under one model.
struct ImageErrors {
  std::size_t image = 0;  ///< of the images that were given
  CameraFromPattern camera_from_pattern;
  std::vector<int> corner_ids;
  std::vector<Eigen::Vector2d> pixels;     ///< where corners were found
  std::vector<Eigen::Vector2d> errors_px;  ///< model minus found: the residual field
  double mean_px = 0.0;
  double rms_px = 0.0;
};

/// What one model makes of the images.
struct ModelCalibration {
  LensModel model = LensModel::kFisheyeK;
  /// Why the model cannot be used; empty where it can. All below is set where a camera was found.
  std::string failure;
  std::vector<std::string> warnings;

  CameraModel camera;
  BoardWarp warp;  ///< zero where it was not estimated
  bool warp_estimated = false;
  double mean_error_px = 0.0;  ///< mean of the corners' distances: the paper's measure
  double rms_px = 0.0;         ///< root of the mean of their squares: OpenCV's and mrcal's measure
  /// Mean distance in images that were not used: camera and warp from every second image, poses
  /// alone fitted in the others, and the reverse. NaN where a half is too small for it.
  double cross_validation_px = std::numeric_limits<double>::quiet_NaN();
  std::optional<BundleCovariance> covariance;  ///< with the standard deviations
  std::vector<ImageErrors> images;
  int corners = 0;
  double seconds = 0.0;

  bool Usable() const { return failure.empty(); }
};

struct RejectedImage {
  std::string name;
  std::string reason;
};

struct IntrinsicsCalibration {
  std::vector<ModelCalibration> models;  ///< in the order asked for
  int best = -1;                         ///< of the models; -1 where none is usable
  std::vector<std::size_t> images_used;
  std::vector<RejectedImage> images_rejected;
  int corners_rejected = 0;
};

/// Step 1 of Section III-B and more: a camera of each model from images of one board, all of one
/// size, without a guess. Images and corners that contradict the others are left out, for all
/// models alike, with the reason. Fails with kTooFewPoints for too few images and for those that
/// cannot tell a lens, saying why; with kInvalidInput, kNoConvergence, kCancelled. A model that
/// alone does not fit is no failure. About a second for 20 images and three models.
Result<IntrinsicsCalibration> CalibrateIntrinsics(const CalibrationBoard& board,
                                                  const std::vector<IntrinsicsImage>& images,
                                                  int width, int height,
                                                  const IntrinsicsOptions& options,
                                                  const RunContext& context);

}  // namespace foresight
