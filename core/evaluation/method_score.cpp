#include "core/evaluation/method_score.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/depth/depth_method.h"

namespace foresight {
namespace {

constexpr float kOutlier_m = 0.050f;
constexpr float kOutlierFraction = 0.01f;

/// Precision and recall of the rejection over the samples whose pixel has a truth.
void ScoreRejection(const AlignedSamples& samples, const DepthImage& truth_m, MethodScore& score) {
  double outliers = 0.0, rejected = 0.0, both = 0.0;
  for (std::size_t i = 0; i < samples.samples.size(); ++i) {
    const AlignedSample& s = samples.samples[i];
    const auto x = std::clamp(static_cast<int>(std::lround(s.u)), 0, truth_m.width() - 1);
    const auto y = std::clamp(static_cast<int>(std::lround(s.v)), 0, truth_m.height() - 1);
    const float truth = truth_m(x, y);
    if (std::isnan(truth)) continue;
    const float error = std::abs(s.depth_m - truth);
    const bool outlier = error > kOutlier_m && error > kOutlierFraction * truth;
    const bool was_rejected = samples.reasons[i] != RejectReason::kKept;
    outliers += outlier ? 1.0 : 0.0;
    rejected += was_rejected ? 1.0 : 0.0;
    both += outlier && was_rejected ? 1.0 : 0.0;
  }
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  score.rejection_precision = rejected > 0.0 ? both / rejected : nothing;
  score.rejection_recall = outliers > 0.0 ? both / outliers : nothing;
}

}  // namespace

Result<MethodScore> ScoreMethod(const std::string& scene, DepthMethod method,
                                const DepthResult& result, const DepthImage& truth_m, int stride) {
  MethodScore score;
  score.scene = scene;
  score.method = InfoOf(method).name;
  score.samples = result.samples.samples.size();
  score.rejected = score.samples - result.samples.KeptCount();
  score.seconds = result.seconds;
  FORESIGHT_TRY(score.with_mask, ScoreDepth(result.dense.depth_m, result.mask, truth_m, stride));
  const MaskImage everything(result.mask.width(), result.mask.height(), 255);
  FORESIGHT_TRY(score.without_mask, ScoreDepth(result.dense.depth_m, everything, truth_m, stride));
  ScoreRejection(result.samples, truth_m, score);
  return score;
}

}  // namespace foresight
