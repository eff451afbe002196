#pragma once

#include <string>
#include <vector>

#include "core/depth/pipeline.h"
#include "core/evaluation/depth_accuracy.h"
#include "core/evaluation/stereo_testbed.h"

namespace foresight {

struct StereoEvaluationOptions {
  StereoTestbedOptions testbed;
  DepthOptions depth;
  int enlarge = 1;  ///< 4 gives quarter-size scenes their full-size geometry
};

/// One row of Table I: a method on a scene.
struct StereoEvaluation {
  std::string scene;
  std::string method;
  DepthAccuracy with_mask;
  DepthAccuracy without_mask;  ///< "w/o C"
  std::size_t samples = 0;
  std::size_t rejected = 0;
  double seconds = 0.0;  ///< of the depth pipeline, without loading and scoring
};

/// The settings of Section V-A in the literal reading: sigma_s 20 px, cells of 4 x 12 px.
DepthOptions PaperTestbedOptions();

/// Runs the depth pipeline on a scene and scores it. Enlarged scenes are scored on every fifth row
/// and column, a number without common factor with the sampling steps.
Result<StereoEvaluation> EvaluateOnScene(const StereoScene& scene,
                                         const StereoEvaluationOptions& options,
                                         const RunContext& context);

}  // namespace foresight
