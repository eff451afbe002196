#pragma once

#include <string>

#include "core/depth/pipeline.h"
#include "core/evaluation/depth_accuracy.h"

namespace foresight {

/// One row of Table I: a method on a scene.
struct MethodScore {
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

/// A score with the result that it is of: for images.
struct ScoredDepth {
  MethodScore score;
  DepthResult result;
};

/// Scores what a method made of the scene called `scene`. A sample counts as an outlier when it is
/// more than 50 mm and more than 1 % off the truth of its pixel.
/// @param truth_m NaN = not scored; @param stride as in ScoreDepth. Fails as ScoreDepth does.
Result<MethodScore> ScoreMethod(const std::string& scene, DepthMethod method,
                                const DepthResult& result, const DepthImage& truth_m, int stride);

}  // namespace foresight
