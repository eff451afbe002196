#include "core/calibration/camera_refit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

namespace foresight {
namespace {

/// Moves a start until the lens no longer shows a sample, at most.
constexpr int kMostSteps = 200;

struct Sample {
  Eigen::Vector2d pixel;
  Eigen::Vector3d ray;
};

struct Fit {
  CameraModel camera;
  double squares = 0.0;  ///< over the samples that are shown
  std::vector<Sample> samples;
};

struct Equations {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd gradient;
  double squares = 0.0;
  bool all_shown = true;
};

Equations Linearize(const CameraModel& camera, const std::vector<Sample>& samples) {
  const Eigen::Index count = camera.Values().size();
  Equations equations{Eigen::MatrixXd::Zero(count, count), Eigen::VectorXd::Zero(count)};
  CameraModel::ByParameters by_parameters;
  for (const Sample& sample : samples) {
    const auto pixel = camera.Project(sample.ray, nullptr, &by_parameters);
    if (!pixel) {
      equations.all_shown = false;
      return equations;
    }
    const Eigen::Vector2d error = *pixel - sample.pixel;
    equations.squares += error.squaredNorm();
    equations.matrix += by_parameters.transpose() * by_parameters;
    equations.gradient += by_parameters.transpose() * error;
  }
  return equations;
}

/// Levenberg-Marquardt; a step that hides a sample is refused.
std::optional<Fit> FitSamples(const CameraModel& start, const std::vector<Sample>& all) {
  Fit fit{start, 0.0, {}};
  for (const Sample& sample : all)
    if (start.Project(sample.ray)) fit.samples.push_back(sample);
  if (2 * fit.samples.size() < all.size() ||
      fit.samples.size() < static_cast<std::size_t>(start.Values().size()))
    return std::nullopt;
  Equations here = Linearize(fit.camera, fit.samples);
  double damping = 1e-3;
  for (int i = 0; i < kMostSteps && damping < 1e12; ++i) {
    Eigen::MatrixXd damped = here.matrix;
    damped.diagonal() *= 1.0 + damping;
    damped.diagonal().array() += 1e-300;
    const CameraModel::Parameters step = -damped.ldlt().solve(here.gradient);
    if (!step.allFinite()) return std::nullopt;
    const CameraModel next = fit.camera.WithValues(fit.camera.Values() + step);
    Equations there = Linearize(next, fit.samples);
    if (next.FindFault() || !there.all_shown || !(there.squares < here.squares)) {
      damping *= 5.0;
      continue;
    }
    const bool settled = here.squares - there.squares < 1e-14 * here.squares;
    fit.camera = next;
    here = std::move(there);
    damping *= 0.1;
    if (settled) break;
  }
  fit.squares = here.squares;
  return fit;
}

std::vector<Lens> StartLenses(LensModel model) {
  switch (model) {
    case LensModel::kFisheyeK:
      return {FisheyeLens{1.0}, FisheyeLens{0.6}, FisheyeLens{0.2}};
    case LensModel::kExtendedUnified:
      return {ExtendedUnifiedLens{0.6, 1.1}, ExtendedUnifiedLens{0.5, 1.0},
              ExtendedUnifiedLens{0.2, 1.0}};
    default:
      return {StartLens(model)};
  }
}

}  // namespace

std::vector<Eigen::Vector2d> PixelGrid(const CameraModel& camera, int across) {
  std::vector<Eigen::Vector2d> pixels;
  const int down = std::max(2, across * camera.height / std::max(1, camera.width));
  for (int row = 0; row <= down; ++row)
    for (int column = 0; column <= across; ++column) {
      const Eigen::Vector2d pixel(camera.width * static_cast<double>(column) / across - 0.5,
                                  camera.height * static_cast<double>(row) / down - 0.5);
      if (camera.Unproject(pixel)) pixels.push_back(pixel);
    }
  return pixels;
}

Result<CameraRefit> RefitCamera(const CameraModel& camera, LensModel model,
                                const std::vector<Eigen::Vector2d>& pixels) {
  std::vector<Sample> samples;
  for (const Eigen::Vector2d& pixel : pixels)
    if (const auto ray = camera.Unproject(pixel)) samples.push_back({pixel, *ray});
  std::optional<Fit> best;
  for (const Lens& lens : StartLenses(model)) {
    CameraModel start = camera;
    start.lens = lens;
    const auto fit = FitSamples(start, samples);
    if (!fit || fit->camera.FindFault()) continue;
    if (!best || fit->samples.size() > best->samples.size() ||
        (fit->samples.size() == best->samples.size() && fit->squares < best->squares))
      best = fit;
  }
  if (!best)
    return Fail(ErrorCode::kTooFewPoints,
                "refit from {} to {}: less than half of {} pixels have a ray in both models",
                camera.Key(), ToString(model), pixels.size());
  CameraRefit refit{.camera = best->camera};
  refit.not_shown = static_cast<int>(pixels.size() - best->samples.size());
  refit.rms_error_px = std::sqrt(best->squares / static_cast<double>(best->samples.size()));
  for (const Sample& sample : best->samples) {
    const double error = (*best->camera.Project(sample.ray) - sample.pixel).norm();
    if (error <= refit.max_error_px) continue;
    refit.max_error_px = error;
    refit.max_at = sample.pixel;
  }
  return refit;
}

}  // namespace foresight
