#include "core/evaluation/confidence_fit.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "core/depth/local_plane_upsampler.h"
#include "core/evaluation/enlarge_scene.h"
#include "core/evaluation/logistic_regression.h"
#include "core/selfcheck/held_out_beams.h"

namespace foresight {

Result<ConfidenceExamples> ConfidenceExamplesOf(const StereoScene& scene,
                                                const StereoEvaluationOptions& options, int stride,
                                                const RunContext& context) {
  const StereoScene enlarged = EnlargeScene(scene, options.enlarge);
  FORESIGHT_TRY(StereoTrial trial, MakeStereoTrial(enlarged, options.testbed));
  FORESIGHT_CHECK(RejectOutliers(trial.samples, options.depth, context.Part(0.0, 0.1)));
  SupportTermImages terms;
  LocalPlaneUpsampler upsampler(enlarged.right, options.depth.local_plane);
  upsampler.KeepTerms(terms);
  FORESIGHT_CHECK(upsampler.Update(trial.samples, context.Part(0.1, 1.0)));
  ConfidenceExamples examples{scene.name, options.enlarge, {}, {}};
  const DepthImage& depth_m = upsampler.dense().depth_m;
  for (int y = 0; y < depth_m.height(); y += stride)
    for (int x = 0; x < depth_m.width(); x += stride) {
      const double truth = trial.truth_m(x, y), depth = depth_m(x, y);
      if (std::isnan(depth)) continue;
      SupportTerms of_pixel;
      for (std::size_t i = 0; i < kSupportTerms; ++i) of_pixel[i] = terms[i](x, y);
      examples.terms.push_back(of_pixel);
      examples.right.push_back(std::abs(depth - truth) <= RightWithin_m(truth));
    }
  if (examples.terms.empty())
    return Fail(ErrorCode::kTooFewPoints, "{}: no pixel has a depth", scene.name);
  return examples;
}

ConfidenceWeights FitConfidence(const std::vector<ConfidenceExamples>& examples) {
  Eigen::Index rows = 0;
  for (const ConfidenceExamples& of_scene : examples)
    rows += static_cast<Eigen::Index>(of_scene.terms.size());
  constexpr auto kColumns = static_cast<Eigen::Index>(1 + kSupportTerms);
  Eigen::MatrixXd x(rows, kColumns);
  Eigen::VectorXd y(rows), counts(rows);
  Eigen::Index row = 0;
  for (const ConfidenceExamples& of_scene : examples)
    for (std::size_t i = 0; i < of_scene.terms.size(); ++i, ++row) {
      x(row, 0) = 1.0;
      for (std::size_t term = 0; term < kSupportTerms; ++term)
        x(row, static_cast<Eigen::Index>(1 + term)) = of_scene.terms[i][term];
      y[row] = of_scene.right[i] ? 1.0 : 0.0;
      counts[row] = 1.0 / static_cast<double>(of_scene.terms.size());
    }
  // Nothing is pulled to 0, but where no example varies.
  constexpr double kHardly = 1e-6;
  const Eigen::VectorXd weights =
      LogisticWeights(x, y, counts, Eigen::VectorXd::Constant(kColumns, kHardly));
  ConfidenceWeights fitted;
  fitted.bias = static_cast<float>(weights[0]);
  for (std::size_t term = 0; term < kSupportTerms; ++term)
    fitted.of[term] = static_cast<float>(weights[static_cast<Eigen::Index>(1 + term)]);
  return fitted;
}

ConfidencePromise PromiseOf(const ConfidenceWeights& weights,
                            const std::vector<ConfidenceExamples>& examples) {
  ConfidencePromise promise;
  constexpr double kLeast = 1e-6;
  for (const ConfidenceExamples& of_scene : examples) {
    double loss = 0.0;
    for (std::size_t i = 0; i < of_scene.terms.size(); ++i) {
      const double p = weights.Confidence(of_scene.terms[i]);
      const bool right = of_scene.right[i];
      loss -= std::log(std::max(kLeast, right ? p : 1.0 - p));
      auto& of_class =
          promise.classes[std::min(promise.classes.size() - 1, static_cast<std::size_t>(10.0 * p))];
      of_class.promised += p;
      of_class.right += right ? 1.0 : 0.0;
      ++of_class.pixels;
    }
    promise.log_loss += loss / static_cast<double>(of_scene.terms.size() * examples.size());
  }
  for (ConfidencePromise::Class& of_class : promise.classes) {
    if (of_class.pixels == 0) continue;
    of_class.promised /= static_cast<double>(of_class.pixels);
    of_class.right /= static_cast<double>(of_class.pixels);
  }
  return promise;
}

}  // namespace foresight
