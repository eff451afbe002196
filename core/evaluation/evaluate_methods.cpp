#include "core/evaluation/evaluate_methods.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace foresight {
namespace {

constexpr int kStrideOfEnlarged = 5;
constexpr double kTestbedSigma_px = 20.0;
constexpr float kOutlier_m = 0.050f;
constexpr float kOutlierShare = 0.01f;

/// Precision and recall of the rejection over the samples whose pixel has a truth.
void ScoreRejection(const AlignedSamples& samples, const DepthImage& truth_m,
                    StereoEvaluation& evaluation) {
  double outliers = 0.0, rejected = 0.0, both = 0.0;
  for (std::size_t i = 0; i < samples.samples.size(); ++i) {
    const AlignedSample& s = samples.samples[i];
    const auto x = std::clamp(static_cast<int>(std::lround(s.u)), 0, truth_m.width() - 1);
    const auto y = std::clamp(static_cast<int>(std::lround(s.v)), 0, truth_m.height() - 1);
    const float truth = truth_m(x, y);
    if (std::isnan(truth)) continue;
    const float error = std::abs(s.depth_m - truth);
    const bool outlier = error > kOutlier_m && error > kOutlierShare * truth;
    const bool was_rejected = samples.reasons[i] != RejectReason::kKept;
    outliers += outlier ? 1.0 : 0.0;
    rejected += was_rejected ? 1.0 : 0.0;
    both += outlier && was_rejected ? 1.0 : 0.0;
  }
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  evaluation.rejection_precision = rejected > 0.0 ? both / rejected : nothing;
  evaluation.rejection_recall = outliers > 0.0 ? both / outliers : nothing;
}

}  // namespace

DepthOptions TestbedOptionsOf(DepthMethod method) {
  DepthOptions options = DefaultsOf(method);
  options.upsample.sigma_spatial_px = kTestbedSigma_px;
  const StereoTestbedOptions testbed;
  options.isolated.along_line_px = testbed.column_step_px;
  options.isolated.between_lines_px = testbed.row_step_px;
  options.local_plane.along_line_px = testbed.column_step_px;
  options.local_plane.between_lines_px = testbed.row_step_px;
  return options;
}

Result<StereoEvaluation> EvaluateOnScene(const StereoScene& scene,
                                         const StereoEvaluationOptions& options,
                                         const RunContext& context) {
  if (options.enlarge < 1 || options.enlarge > 16)
    return Fail(ErrorCode::kInvalidOptions, "evaluation: scale {} is not in [1, 16]",
                options.enlarge);
  const StereoScene sized = EnlargeScene(scene, options.enlarge);
  FORESIGHT_TRY(StereoTrial trial, MakeStereoTrial(sized, options.testbed));
  StereoEvaluation evaluation;
  evaluation.scene = scene.name;
  evaluation.method = InfoOf(options.depth.method).name;
  evaluation.samples = trial.samples.samples.size();
  FORESIGHT_TRY(const DepthResult result,
                ComputeDepth(std::move(trial.samples), sized.right, options.depth, context));
  evaluation.rejected = evaluation.samples - result.samples.KeptCount();
  evaluation.seconds = result.seconds;
  ScoreRejection(result.samples, trial.truth_m, evaluation);
  const int stride = options.enlarge > 1 ? kStrideOfEnlarged : 1;
  FORESIGHT_TRY(evaluation.with_mask,
                ScoreDepth(result.dense.depth_m, result.mask, trial.truth_m, stride));
  const MaskImage everything(result.mask.width(), result.mask.height(), 255);
  FORESIGHT_TRY(evaluation.without_mask,
                ScoreDepth(result.dense.depth_m, everything, trial.truth_m, stride));
  return evaluation;
}

}  // namespace foresight
