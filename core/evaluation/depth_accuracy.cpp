#include "core/evaluation/depth_accuracy.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/quantile.h"

namespace foresight {

double Percentile(std::vector<double> values, double p) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double last = static_cast<double>(values.size() - 1);
  const double rank = std::ceil(p / 100.0 * static_cast<double>(values.size())) - 1.0;
  return ValueAtRank(std::move(values), static_cast<std::size_t>(std::clamp(rank, 0.0, last)));
}

Result<DepthAccuracy> ScoreDepth(const DepthImage& depth_m, const MaskImage& mask,
                                 const DepthImage& truth_m, int stride) {
  FORESIGHT_EXPECTS(stride >= 1, "a stride of pixels is at least 1");
  if (!depth_m.SameSize(truth_m) || !depth_m.SameSize(mask))
    return Fail(ErrorCode::kInvalidInput,
                "depth {} x {}, mask {} x {} and truth {} x {} differ in size", depth_m.width(),
                depth_m.height(), mask.width(), mask.height(), truth_m.width(), truth_m.height());
  std::vector<double> errors_mm;
  std::int64_t with_truth = 0, without_truth = 0, invented = 0;
  for (int y = 0; y < depth_m.height(); y += stride)
    for (int x = 0; x < depth_m.width(); x += stride) {
      const bool kept = mask(x, y) != 0 && !std::isnan(depth_m(x, y));
      if (std::isnan(truth_m(x, y))) {
        ++without_truth;
        invented += kept ? 1 : 0;
        continue;
      }
      ++with_truth;
      if (kept)
        errors_mm.push_back(1000.0 * std::abs(static_cast<double>(depth_m(x, y)) - truth_m(x, y)));
    }
  DepthAccuracy accuracy;
  accuracy.scored = static_cast<std::int64_t>(errors_mm.size());
  accuracy.a80_mm = Percentile(errors_mm, 80.0);
  accuracy.a95_mm = Percentile(errors_mm, 95.0);
  const auto fraction = [](std::int64_t part, std::int64_t whole) {
    return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0.0;
  };
  accuracy.coverage = fraction(accuracy.scored, with_truth);
  accuracy.unscored_kept = fraction(invented, without_truth);
  return accuracy;
}

}  // namespace foresight
