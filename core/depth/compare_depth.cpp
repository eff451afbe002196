#include "core/depth/compare_depth.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/contract.h"

namespace foresight {
namespace {

void Count(double difference_m, DepthComparison& comparison) {
  constexpr double kBin_m = 2.0 * DepthComparison::kFullScale_m / DepthComparison::kBins;
  const double bin = std::floor((difference_m + DepthComparison::kFullScale_m) / kBin_m);
  if (bin < 0.0)
    ++comparison.below_histogram;
  else if (bin >= static_cast<double>(DepthComparison::kBins))
    ++comparison.above_histogram;
  else
    ++comparison.histogram[static_cast<std::size_t>(bin)];
}

}  // namespace

DepthComparison CompareDepth(const DepthImage& first_m, const MaskImage& first_mask,
                             const DepthImage& second_m, const MaskImage& second_mask) {
  FORESIGHT_EXPECTS(
      first_m.SameSize(second_m) && first_m.SameSize(first_mask) && first_m.SameSize(second_mask),
      "both depth maps and their masks have one size");
  DepthComparison comparison;
  comparison.difference_m =
      DepthImage(first_m.width(), first_m.height(), std::numeric_limits<float>::quiet_NaN());
  std::vector<float> sizes_m;
  double sum_m = 0.0;
  for (std::size_t i = 0; i < first_m.size(); ++i) {
    const float first = first_m.values()[i], second = second_m.values()[i];
    const bool in_first = std::isfinite(first) && first_mask.values()[i] != 0;
    const bool in_second = std::isfinite(second) && second_mask.values()[i] != 0;
    comparison.only_in_first += in_first && !in_second ? 1 : 0;
    comparison.only_in_second += in_second && !in_first ? 1 : 0;
    comparison.in_neither += !in_first && !in_second ? 1 : 0;
    if (!in_first || !in_second) continue;
    ++comparison.in_both;
    const float difference = second - first;
    comparison.difference_m.values()[i] = difference;
    sizes_m.push_back(std::abs(difference));
    sum_m += difference;
    Count(difference, comparison);
  }
  if (sizes_m.empty()) return comparison;
  std::sort(sizes_m.begin(), sizes_m.end());
  const auto quantile = [&](double fraction) -> double {
    return sizes_m[static_cast<std::size_t>(fraction * static_cast<double>(sizes_m.size() - 1) +
                                            0.5)];
  };
  comparison.median_abs_m = quantile(0.5);
  comparison.p95_abs_m = quantile(0.95);
  comparison.max_abs_m = sizes_m.back();
  comparison.mean_m = sum_m / static_cast<double>(sizes_m.size());
  return comparison;
}

}  // namespace foresight
