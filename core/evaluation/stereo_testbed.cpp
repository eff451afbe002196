#include "core/evaluation/stereo_testbed.h"

#include <cmath>
#include <limits>

#include "core/base/random.h"

namespace foresight {
namespace {

/// Neighbouring pixels whose disparity differs by more lie on different surfaces.
constexpr double kOneSurface_px = 1.0;

}  // namespace

Status StereoTestbedOptions::Check() const {
  if (column_step_px < 1 || row_step_px < 1 || column_step_px > 1000 || row_step_px > 1000)
    return Fail(ErrorCode::kInvalidOptions, "testbed: steps of {} x {} px are not in [1, 1000]",
                column_step_px, row_step_px);
  if (!(noise_sigma_m >= 0.0 && noise_sigma_m < 1.0))
    return Fail(ErrorCode::kInvalidOptions, "testbed: noise_sigma_m {} is not in [0, 1)",
                noise_sigma_m);
  return {};
}

Result<StereoTrial> MakeStereoTrial(const StereoScene& scene, const StereoTestbedOptions& options) {
  FORESIGHT_CHECK(options.Check());
  StereoTrial trial;
  AlignedSamples& out = trial.samples;
  const FloatImage& disparity = scene.left_disparity;
  out.width = disparity.width();
  out.height = disparity.height();
  out.lines = (out.height + options.row_step_px - 1) / options.row_step_px;
  out.beams = (out.width + options.column_step_px - 1) / options.column_step_px;
  Random random(options.seed);
  for (int line = 0; line < out.lines; ++line)
    for (int beam = 0; beam < out.beams; ++beam) {
      // Drawn for every cell, so that a hole does not shift the noise of all that follows.
      const double noise_m = options.noise_sigma_m * random.Normal();
      const int x = beam * options.column_step_px;
      const int y = line * options.row_step_px;
      if (std::isnan(disparity(x, y))) continue;
      const double depth_m = scene.DepthOf(disparity(x, y)) + noise_m;
      if (!(depth_m > 0.0)) continue;
      const double u = x - scene.DisparityOf(depth_m);
      if (!(u >= -0.5 && u < out.width - 0.5)) continue;
      AlignedSample sample;
      sample.u = static_cast<float>(u);
      sample.v = static_cast<float>(y);
      sample.depth_m = static_cast<float>(depth_m);
      sample.line = line;
      sample.beam = beam;
      sample.point =
          Eigen::Vector3f(static_cast<float>((u - scene.right_cx) * depth_m / scene.focal_px),
                          static_cast<float>((y - scene.cy) * depth_m / scene.focal_px),
                          static_cast<float>(depth_m));
      out.samples.push_back(sample);
    }
  if (out.samples.empty())
    return Fail(ErrorCode::kTooFewPoints, "{}: no sample lands in the right view", scene.name);
  out.reasons.assign(out.samples.size(), RejectReason::kKept);
  trial.truth_m = TruthOfRight(scene);
  return trial;
}

DepthImage TruthOfRight(const StereoScene& scene) {
  if (scene.right_disparity.empty()) return WarpTruthToRight(scene);
  DepthImage truth = scene.right_disparity;
  for (float& value : truth.values())
    value = static_cast<float>(scene.DepthOf(static_cast<double>(value)));
  return truth;
}

DepthImage WarpTruthToRight(const StereoScene& scene) {
  const FloatImage& disparity = scene.left_disparity;
  DepthImage truth(disparity.width(), disparity.height(), std::numeric_limits<float>::quiet_NaN());
  const auto usable = [&](int x, int y) {
    return x < disparity.width() && !std::isnan(disparity(x, y)) && scene.left_in_both(x, y) == 255;
  };
  const auto put = [&](int x, int y, double disparity_px) {
    if (x < 0 || x >= truth.width()) return;
    const auto depth = static_cast<float>(scene.DepthOf(disparity_px));
    if (!(truth(x, y) <= depth)) truth(x, y) = depth;
  };
  for (int y = 0; y < disparity.height(); ++y)
    for (int x = 0; x < disparity.width(); ++x) {
      if (!usable(x, y)) continue;
      const double here = disparity(x, y);
      const double from = x - here;
      put(static_cast<int>(std::lround(from)), y, here);
      if (!usable(x + 1, y)) continue;
      const double next = disparity(x + 1, y);
      const double to = x + 1 - next;
      if (std::abs(next - here) > kOneSurface_px || !(to > from)) continue;
      for (int u = static_cast<int>(std::ceil(from)); u <= to; ++u)
        put(u, y, here + (next - here) * (u - from) / (to - from));
    }
  return truth;
}

}  // namespace foresight
