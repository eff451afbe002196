#include "core/evaluation/evaluate_methods.h"

namespace foresight {
namespace {

constexpr int kStrideOfEnlarged = 5;

}  // namespace

DepthOptions PaperTestbedOptions() {
  DepthOptions options;
  options.upsample.sigma_spatial_px = 20.0;
  const StereoTestbedOptions testbed;
  options.isolated.along_line_px = testbed.column_step_px;
  options.isolated.between_lines_px = testbed.row_step_px;
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
  evaluation.method = "paper";
  evaluation.samples = trial.samples.samples.size();
  FORESIGHT_TRY(const DepthResult result,
                ComputeDepth(std::move(trial.samples), sized.right, options.depth, context));
  evaluation.rejected = evaluation.samples - result.samples.KeptCount();
  evaluation.seconds = result.seconds;
  const int stride = options.enlarge > 1 ? kStrideOfEnlarged : 1;
  FORESIGHT_TRY(evaluation.with_mask,
                ScoreDepth(result.dense.depth_m, result.mask, trial.truth_m, stride));
  const MaskImage everything(result.mask.width(), result.mask.height(), 255);
  FORESIGHT_TRY(evaluation.without_mask,
                ScoreDepth(result.dense.depth_m, everything, trial.truth_m, stride));
  return evaluation;
}

}  // namespace foresight
