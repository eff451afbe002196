#include "core/evaluation/evaluate_methods.h"

#include "core/evaluation/enlarge_scene.h"

namespace foresight {
namespace {

constexpr double kTestbedSigma_px = 20.0;

}  // namespace

int ScoreStride(int enlarge) {
  constexpr int kOfEnlarged = 5;
  return enlarge > 1 ? kOfEnlarged : 1;
}

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

Result<StereoRun> RunOnScene(const StereoScene& scene, const StereoEvaluationOptions& options,
                             const RunContext& context) {
  if (options.enlarge < 1 || options.enlarge > 16)
    return Fail(ErrorCode::kInvalidOptions, "evaluation: scale {} is not in [1, 16]",
                options.enlarge);
  StereoRun run;
  run.scene = EnlargeScene(scene, options.enlarge);
  FORESIGHT_TRY(StereoTrial trial, MakeStereoTrial(run.scene, options.testbed));
  run.truth_m = std::move(trial.truth_m);
  FORESIGHT_TRY(run.depth.result,
                ComputeDepth(std::move(trial.samples), run.scene.right, options.depth, context));
  FORESIGHT_TRY(run.depth.score, ScoreMethod(scene.name, options.depth.method, run.depth.result,
                                             run.truth_m, ScoreStride(options.enlarge)));
  return run;
}

Result<MethodScore> EvaluateOnScene(const StereoScene& scene,
                                    const StereoEvaluationOptions& options,
                                    const RunContext& context) {
  FORESIGHT_TRY(StereoRun run, RunOnScene(scene, options, context));
  return std::move(run.depth.score);
}

}  // namespace foresight
