#pragma once

#include <string>
#include <vector>

#include "core/depth/measured_support.h"
#include "core/evaluation/evaluate_methods.h"

namespace foresight {

/// Pixels of one scene at one size with what their confidence is computed from, and how they are.
struct ConfidenceExamples {
  std::string scene;
  int enlarge = 1;
  std::vector<SupportTerms> terms;
  /// Within 50 mm or 1 % of the truth; where there is none, in what the lidar did not see, a depth
  /// is invented, and wrong.
  std::vector<bool> right;
};

/// Runs Foresight's method on a stereo scene as StereoEvaluationOptions says, and keeps every
/// `stride`-th row and column that has a depth. Fails as RunOnScene does.
Result<ConfidenceExamples> ConfidenceExamplesOf(const StereoScene& scene,
                                                const StereoEvaluationOptions& options, int stride,
                                                const RunContext& context);

/// The weights that make the examples likeliest; each scene at each size counts alike.
ConfidenceWeights FitConfidence(const std::vector<ConfidenceExamples>& examples);

/// How well weights promise.
struct ConfidencePromise {
  double log_loss = 0.0;  ///< mean of -log(what was promised for what came true), scenes alike
  /// Of ten classes of confidence, the mean of it, the fraction that is right and the pixels.
  struct Class {
    double promised = 0.0;
    double right = 0.0;
    std::size_t pixels = 0;
  };
  std::array<Class, 10> classes;
};
ConfidencePromise PromiseOf(const ConfidenceWeights& weights,
                            const std::vector<ConfidenceExamples>& examples);

}  // namespace foresight
