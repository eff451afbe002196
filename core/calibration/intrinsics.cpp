#include "core/calibration/intrinsics.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>

#include "core/calibration/fit_lens.h"
#include "core/calibration/intrinsics_start.h"
#include "core/calibration/select_images.h"
#include "core/calibration/view_geometry.h"
#include "core/calibration/zoom_groups.h"

namespace foresight {
namespace {

/// Models whose cross-validation differs by less than this fraction predict equally well.
constexpr double kEqualPrediction = 0.005;
/// A relative standard deviation of the focal length that is worth a remark.
constexpr double kRemarkableFocalSigma = 0.003;
constexpr double kRemarkableRms_px = 0.9;

double SecondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Status CheckImages(const CalibrationBoard& board, const std::vector<IntrinsicsImage>& images,
                   int width, int height, const IntrinsicsOptions& options) {
  FORESIGHT_CHECK(options.Check());
  FORESIGHT_CHECK(board.Check());
  if (static_cast<int>(images.size()) < options.min_images)
    return Fail(ErrorCode::kTooFewPoints,
                "{} image{} with a board: a camera needs at least {}, and 15 to 30 are a good "
                "number",
                images.size(), images.size() == 1 ? "" : "s", options.min_images);
  std::vector<BoardView> views;
  for (const IntrinsicsImage& image : images) {
    if (const Status status = image.view.Check(board); !status)
      return Fail(status.error().code, "{}: {}", image.name, status.error().message);
    views.push_back(image.view);
  }
  if (const std::string fault = CoverageFault(CoverageOf(views, width, height)); !fault.empty())
    return Fail(ErrorCode::kTooFewPoints,
                "{}: the lens is not seen elsewhere; take images with the board in every part of "
                "the image",
                fault);
  return {};
}

/// Whether a warp predicts images better that were not used.
Result<bool> WarpHelps(const CameraBundle& reference, const IntrinsicsOptions& options,
                       const RunContext& context) {
  if (options.warp != IntrinsicsOptions::Warp::kAuto)
    return options.warp == IntrinsicsOptions::Warp::kOn;
  FORESIGHT_TRY(const CameraBundle flat,
                FitLens(reference, LensModel::kKannalaBrandt, {.free_warp = false}, context));
  FORESIGHT_TRY(const CameraBundle bent,
                FitLens(reference, LensModel::kKannalaBrandt, {.free_warp = true}, context));
  FORESIGHT_TRY(const double with_flat, CrossValidate(flat, false, context));
  FORESIGHT_TRY(const double with_bent, CrossValidate(bent, true, context));
  return with_bent < (1.0 - kEqualPrediction) * with_flat;
}

ImageErrors ErrorsOf(const CameraBundle& bundle, std::size_t view, std::size_t image) {
  ImageErrors errors{.image = image,
                     .camera_from_pattern = bundle.poses[view],
                     .corner_ids = bundle.views[view].corner_ids,
                     .pixels = bundle.views[view].pixels,
                     .errors_px = ViewErrors(bundle, view)};
  const ErrorSummary summary = SummarizeErrors(errors.errors_px);
  errors.mean_px = summary.mean_px;
  errors.rms_px = summary.rms_px;
  return errors;
}

/// A camera with more pixels has larger errors in pixels.
double ErrorScale(const CameraModel& camera) {
  constexpr double kUsualDiagonal_px = 1300.0;
  return std::max(1.0, std::hypot(camera.width, camera.height) / kUsualDiagonal_px);
}

/// Images of two zooms, in words; nearer boards explain so much of a longer focal length that the
/// errors alone do not show them.
std::string DescribeZooms(const CameraBundle& bundle, const std::vector<std::string>& names) {
  const auto groups = FindZoomGroups(FocalOfEachView(bundle));
  if (!groups) return "";
  const auto list = [&](const std::vector<std::size_t>& views) {
    constexpr std::size_t kMost = 3;
    std::string text;
    for (std::size_t i = 0; i < std::min(views.size(), kMost); ++i)
      text += (i == 0 ? "" : ", ") + names[views[i]];
    return views.size() > kMost ? fmt::format("{} and {} more", text, views.size() - kMost) : text;
  };
  return fmt::format(
      "the images are of two focal lengths, {:.0f} % apart: {} ask for the shorter one, {} for the "
      "longer one. Was the zoom or the focus changed between them?",
      100.0 * (groups->ratio - 1.0), list(groups->shorter), list(groups->longer));
}

/// Says why a camera cannot be relied on, or what is weak about it.
void Judge(const CameraBundle& bundle, const std::vector<std::string>& names,
           const IntrinsicsOptions& options, ModelCalibration& calibration) {
  constexpr const char* kAdvice =
      "tilt the board by 20 to 45 deg in different directions, near and far";
  if (!calibration.covariance) {
    calibration.failure =
        fmt::format("the images do not determine the lens: {}; {}", DescribeViews(bundle), kAdvice);
    return;
  }
  const double scale = ErrorScale(calibration.camera);
  if (calibration.rms_px > scale * options.largest_rms_px) {
    calibration.failure = fmt::format(
        "corners are {:.1f} px (rms) off: the model is not that of the lens, or the "
        "images are not of one camera with one zoom and focus",
        calibration.rms_px);
    return;
  }
  calibration.failure = DescribeZooms(bundle, names);
  if (!calibration.failure.empty()) return;
  if (calibration.rms_px > scale * kRemarkableRms_px)
    calibration.warnings.push_back(fmt::format(
        "corners are {:.2f} px (rms) off, where good images have 0.2 to 0.6 px: look for "
        "another model, a changed zoom or focus, a board that bends",
        calibration.rms_px));
  const CameraModel::Parameters sigmas = calibration.covariance->ValueSigmas();
  const double focal_sigma =
      std::max(sigmas[0] / calibration.camera.fx, sigmas[1] / calibration.camera.fy);
  if (focal_sigma > options.largest_focal_sigma)
    calibration.failure =
        fmt::format("the focal length is not observable (known to +-{:.1f} %): {}; {}",
                    100.0 * focal_sigma, DescribeViews(bundle), kAdvice);
  else if (focal_sigma > kRemarkableFocalSigma)
    calibration.warnings.push_back(fmt::format("the focal length is known to +-{:.2f} % only; {}",
                                               100.0 * focal_sigma, kAdvice));
  if (calibration.warp.x_m != 0.0 || calibration.warp.y_m != 0.0) {
    const double warp_mm = 1000.0 * std::hypot(calibration.warp.x_m, calibration.warp.y_m);
    if (warp_mm > 0.5)
      calibration.warnings.push_back(fmt::format("the board is bent by {:.1f} mm", warp_mm));
  }
}

/// @param names of the selected images
Result<ModelCalibration> Calibrate(const SelectedImages& selected,
                                   const std::vector<std::string>& names, LensModel model,
                                   bool free_warp, const IntrinsicsOptions& options,
                                   const RunContext& context) {
  const auto start = std::chrono::steady_clock::now();
  ModelCalibration calibration;
  calibration.model = model;
  calibration.warp_estimated = free_warp;
  const auto fitted = FitLens(selected.bundle, model, {.free_warp = free_warp}, context);
  if (!fitted && fitted.error().code == ErrorCode::kCancelled)
    return tl::unexpected(fitted.error());
  if (!fitted) {
    calibration.failure = fitted.error().message;
    calibration.seconds = SecondsSince(start);
    return calibration;
  }
  calibration.camera = fitted->camera;
  calibration.warp = fitted->warp;
  const ErrorSummary summary = SummarizeErrors(*fitted);
  calibration.mean_error_px = summary.mean_px;
  calibration.rms_px = summary.rms_px;
  calibration.corners = summary.corners;
  for (std::size_t view = 0; view < fitted->views.size(); ++view)
    calibration.images.push_back(ErrorsOf(*fitted, view, selected.images[view]));
  calibration.covariance = BundleCovariance::Of(*fitted, free_warp);
  FORESIGHT_TRY(calibration.cross_validation_px, CrossValidate(*fitted, free_warp, context));
  Judge(*fitted, names, options, calibration);
  calibration.seconds = SecondsSince(start);
  return calibration;
}

/// By cross-validation, or by the residual where there is none; of equals the one with fewer
/// parameters.
int Best(const std::vector<ModelCalibration>& models) {
  const auto measure = [](const ModelCalibration& m) {
    return std::isfinite(m.cross_validation_px) ? m.cross_validation_px : m.rms_px;
  };
  int best = -1;
  for (int i = 0; i < static_cast<int>(models.size()); ++i) {
    const ModelCalibration& candidate = models[static_cast<std::size_t>(i)];
    if (!candidate.Usable()) continue;
    if (best < 0) {
      best = i;
      continue;
    }
    const ModelCalibration& champion = models[static_cast<std::size_t>(best)];
    const double ratio = measure(candidate) / measure(champion);
    const bool fewer = candidate.camera.Values().size() < champion.camera.Values().size();
    if (ratio < 1.0 - kEqualPrediction || (fewer && ratio < 1.0 + kEqualPrediction)) best = i;
  }
  return best;
}

}  // namespace

Status IntrinsicsOptions::Check() const {
  if (models.empty()) return Fail(ErrorCode::kInvalidOptions, "intrinsics: no camera model given");
  if (std::set<LensModel>(models.begin(), models.end()).size() != models.size())
    return Fail(ErrorCode::kInvalidOptions, "intrinsics: a camera model is given twice");
  if (min_images < 4)
    return Fail(ErrorCode::kInvalidOptions, "intrinsics: min_images {} is below 4", min_images);
  const auto is_ratio = [](double value) { return value == 0.0 || value >= 2.0; };
  if (!is_ratio(image_outlier_ratio))
    return Fail(ErrorCode::kInvalidOptions,
                "intrinsics: image_outlier_ratio {} is neither 0 (never) nor 2 or more",
                image_outlier_ratio);
  if (!is_ratio(corner_outlier_ratio))
    return Fail(ErrorCode::kInvalidOptions,
                "intrinsics: corner_outlier_ratio {} is neither 0 (never) nor 2 or more",
                corner_outlier_ratio);
  if (!(image_outlier_floor_px >= 0.0) || !(corner_outlier_floor_px >= 0.0))
    return Fail(ErrorCode::kInvalidOptions, "intrinsics: a floor of outliers is negative");
  if (!(largest_rms_px > 0.0))
    return Fail(ErrorCode::kInvalidOptions, "intrinsics: largest_rms_px {} is not positive",
                largest_rms_px);
  if (!(largest_focal_sigma > 0.0))
    return Fail(ErrorCode::kInvalidOptions, "intrinsics: largest_focal_sigma {} is not positive",
                largest_focal_sigma);
  return {};
}

Result<IntrinsicsCalibration> CalibrateIntrinsics(const CalibrationBoard& board,
                                                  const std::vector<IntrinsicsImage>& images,
                                                  int width, int height,
                                                  const IntrinsicsOptions& options,
                                                  const RunContext& context) {
  FORESIGHT_CHECK(CheckImages(board, images, width, height, options));
  context.Report(0.0, "focal length");
  FORESIGHT_TRY(const SelectedImages selected,
                SelectImages(board, images, width, height, options, context));
  context.Report(0.4, "shape of the board");
  FORESIGHT_TRY(const bool free_warp, WarpHelps(selected.bundle, options, context));

  IntrinsicsCalibration result;
  result.images_used = selected.images;
  result.images_rejected = selected.rejected;
  result.corners_rejected = selected.corners_rejected;
  std::vector<std::string> names;
  for (const std::size_t image : selected.images) names.push_back(images[image].name);
  for (std::size_t i = 0; i < options.models.size(); ++i) {
    context.Report(0.6 + 0.4 * static_cast<double>(i) / static_cast<double>(options.models.size()),
                   "lens");
    FORESIGHT_TRY(ModelCalibration calibration,
                  Calibrate(selected, names, options.models[i], free_warp, options, context));
    result.models.push_back(std::move(calibration));
  }
  result.best = Best(result.models);
  context.Report(1.0, "done");
  return result;
}

}  // namespace foresight
