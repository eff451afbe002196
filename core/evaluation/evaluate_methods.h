#pragma once

#include "core/depth/depth_method.h"
#include "core/evaluation/method_score.h"
#include "core/evaluation/stereo_testbed.h"

namespace foresight {

struct StereoEvaluationOptions {
  StereoTestbedOptions testbed;
  DepthOptions depth;
  int enlarge = 1;  ///< 4 gives quarter-size scenes their full-size geometry
};

/// A method's settings for the testbed: its defaults, with the sigma_s of 20 px that Section V-A
/// uses where the method has one, and the testbed's own sampling steps.
DepthOptions TestbedOptionsOf(DepthMethod method);

/// Every so manieth row and column of a scene that was enlarged so often is scored: a number
/// without common factor with the sampling steps.
int ScoreStride(int enlarge);

/// A scored depth map with what it was computed from: for images.
struct StereoRun {
  StereoScene scene;  ///< enlarged where that was asked for
  DepthImage truth_m;
  ScoredDepth depth;
};

/// Runs the depth pipeline on a scene and scores it at ScoreStride.
Result<StereoRun> RunOnScene(const StereoScene& scene, const StereoEvaluationOptions& options,
                             const RunContext& context);

/// The same, the score alone.
Result<MethodScore> EvaluateOnScene(const StereoScene& scene,
                                    const StereoEvaluationOptions& options,
                                    const RunContext& context);

}  // namespace foresight
