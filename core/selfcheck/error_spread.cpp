#include "core/selfcheck/error_spread.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/base/quantile.h"

namespace foresight {
namespace {

/// Of |n|, where each n is normal with its own deviation.
double QuantileOfNoise(const std::vector<double>& deviations_m, double fraction) {
  double low = 0.0, high = 10.0 * *std::max_element(deviations_m.begin(), deviations_m.end());
  constexpr int kHalvings = 40;
  for (int halving = 0; halving < kHalvings && high > 0.0; ++halving) {
    const double middle = 0.5 * (low + high);
    double below = 0.0;
    for (const double deviation_m : deviations_m)
      below += deviation_m > 0.0 ? std::erf(middle / (std::numbers::sqrt2 * deviation_m)) : 1.0;
    (below < fraction * static_cast<double>(deviations_m.size()) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

double QuantileWithoutNoise(std::span<const NoisyError> errors, double fraction) {
  std::vector<double> sizes_m, deviations_m;
  for (const NoisyError& error : errors) {
    if (!std::isfinite(error.value_m)) continue;
    sizes_m.push_back(std::abs(error.value_m));
    deviations_m.push_back(error.noise_m);
  }
  if (sizes_m.empty()) return std::numeric_limits<double>::quiet_NaN();
  // A few hundred deviations tell their quantile; they differ by little.
  constexpr std::size_t kMost = 300;
  std::vector<double> some_m;
  for (std::size_t i = 0; i < deviations_m.size(); i += 1 + deviations_m.size() / kMost)
    some_m.push_back(deviations_m[i]);
  const double with_m = Quantile(std::move(sizes_m), fraction);
  const double noise_m = QuantileOfNoise(some_m, fraction);
  return std::sqrt(std::max(0.0, with_m * with_m - noise_m * noise_m));
}

}  // namespace foresight
