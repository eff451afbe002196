#pragma once

#include <string>
#include <vector>

#include "core/depth/depth_method.h"
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
  double rejection_precision =
      0.0;  ///< of the rejected samples, those that are outliers; NaN = none rejected
  double rejection_recall = 0.0;  ///< of the outliers, those that were rejected; NaN = none there
  double seconds = 0.0;           ///< of the depth pipeline, without loading and scoring
};

/// A method's settings for the testbed: its defaults, with the sigma_s of 20 px that Section V-A
/// uses where the method has one, and the testbed's own sampling steps.
DepthOptions TestbedOptionsOf(DepthMethod method);

/// Runs the depth pipeline on a scene and scores it. Enlarged scenes are scored on every fifth row
/// and column, a number without common factor with the sampling steps. A sample counts as an
/// outlier when it is more than 50 mm and more than 1 % off the truth of its pixel.
Result<StereoEvaluation> EvaluateOnScene(const StereoScene& scene,
                                         const StereoEvaluationOptions& options,
                                         const RunContext& context);

}  // namespace foresight
