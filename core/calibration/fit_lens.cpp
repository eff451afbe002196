#include "core/calibration/fit_lens.h"

#include <cmath>
#include <limits>
#include <optional>

#include "core/calibration/camera_refit.h"
#include "core/calibration/intrinsics_start.h"

namespace foresight {
namespace {

constexpr double kSmallestK = 0.05;
constexpr double kNotShown_px = 200.0;

std::vector<Eigen::Vector2d> AllPixels(const CameraBundle& bundle) {
  std::vector<Eigen::Vector2d> pixels;
  for (const BoardView& view : bundle.views)
    pixels.insert(pixels.end(), view.pixels.begin(), view.pixels.end());
  return pixels;
}

/// Cameras of the model to start from: one that shows the same rays, or where that cannot be,
/// cameras without distortion of several fields of view.
std::vector<CameraModel> StartCameras(const CameraBundle& near, LensModel model) {
  if (LensModelOf(near.camera.lens) == model) return {near.camera};
  const std::vector<Eigen::Vector2d> pixels = AllPixels(near);
  std::vector<CameraModel> cameras;
  if (const auto refit = RefitCamera(near.camera, model, pixels); refit && refit->not_shown == 0)
    cameras.push_back(refit->camera);
  if (!cameras.empty() && model != LensModel::kRadialTangential) return cameras;
  for (const double scale : {1.0, 0.7, 0.5}) {
    CameraModel camera = near.camera;
    camera.lens = StartLens(model);
    camera.fx *= scale;
    camera.fy *= scale;
    cameras.push_back(camera);
  }
  return cameras;
}

Result<CameraBundle> Adjusted(const CameraBundle& near, const CameraModel& camera,
                              BundleOptions options, const RunContext& context) {
  FORESIGHT_TRY(CameraBundle bundle, WithCamera(near, camera));
  if (!options.free_warp) bundle.warp = {};
  options.free_lens = true;
  FORESIGHT_CHECK(AdjustBundle(bundle, options, context));
  auto* lens = std::get_if<FisheyeLens>(&bundle.camera.lens);
  if (lens == nullptr) return bundle;
  lens->k = std::abs(lens->k);  // the lens is the same
  if (lens->k == 0.0 || lens->k > kSmallestK) return bundle;
  lens->k = 0.0;
  FORESIGHT_TRY(bundle, WithCamera(bundle, bundle.camera));
  options.free_lens = false;
  FORESIGHT_CHECK(AdjustBundle(bundle, options, context));
  return bundle;
}

CameraBundle Half(const CameraBundle& bundle, std::size_t parity) {
  CameraBundle half = bundle;
  half.views.clear();
  half.poses.clear();
  for (std::size_t view = parity; view < bundle.views.size(); view += 2) {
    half.views.push_back(bundle.views[view]);
    half.poses.push_back(bundle.poses[view]);
  }
  return half;
}

/// Sum of the distances in views of which only the poses are fitted.
double SumOfDistances(CameraBundle bundle) {
  double sum = 0.0;
  for (std::size_t view = 0; view < bundle.views.size(); ++view) {
    const auto pose = RefineBoardPose(bundle.board, bundle.views[view], bundle.camera,
                                      bundle.poses[view], bundle.warp, 50);
    if (pose) bundle.poses[view] = pose->camera_from_pattern;
    for (const Eigen::Vector2d& error : ViewErrors(bundle, view))
      sum += error.allFinite() ? error.norm() : kNotShown_px;
  }
  return sum;
}

}  // namespace

Result<CameraBundle> FitLens(const CameraBundle& near, LensModel model,
                             const BundleOptions& options, const RunContext& context) {
  std::optional<CameraBundle> best;
  for (const CameraModel& camera : StartCameras(near, model)) {
    auto bundle = Adjusted(near, camera, options, context);
    if (context.Cancelled()) return Fail(ErrorCode::kCancelled, "calibration was cancelled");
    if (!bundle || bundle->camera.FindFault()) continue;
    if (!best || SummarizeErrors(*bundle).rms_px < SummarizeErrors(*best).rms_px)
      best = std::move(*bundle);
  }
  if (!best)
    return Fail(ErrorCode::kNoConvergence,
                "model {}: no lens of this model shows all corners; it is for a narrower view",
                ToString(model));
  return *best;
}

Result<CameraBundle> FitEverySecond(const CameraBundle& bundle, std::size_t first, bool free_warp,
                                    const RunContext& context) {
  CameraBundle half = Half(bundle, first);
  const bool pinhole = std::holds_alternative<FisheyeLens>(bundle.camera.lens) &&
                       std::get<FisheyeLens>(bundle.camera.lens).k == 0.0;
  FORESIGHT_CHECK(AdjustBundle(half, {.free_lens = !pinhole, .free_warp = free_warp}, context));
  return half;
}

Result<double> CrossValidate(const CameraBundle& bundle, bool free_warp,
                             const RunContext& context) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (bundle.views.size() < 4) return kNone;
  double sum = 0.0;
  for (const std::size_t parity : {std::size_t{0}, std::size_t{1}}) {
    const auto used = FitEverySecond(bundle, parity, free_warp, context);
    if (context.Cancelled()) return Fail(ErrorCode::kCancelled, "calibration was cancelled");
    if (!used) return kNone;
    CameraBundle others = Half(bundle, 1 - parity);
    others.camera = used->camera;
    others.warp = used->warp;
    sum += SumOfDistances(others);
  }
  return sum / bundle.CornerCount();
}

}  // namespace foresight
