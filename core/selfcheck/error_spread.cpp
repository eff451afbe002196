#include "core/selfcheck/error_spread.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/quantile.h"

namespace foresight {

double QuantileWithoutNoise(std::span<const NoisyError> errors, double fraction) {
  std::vector<double> sizes_m, noises_m;
  for (const NoisyError& error : errors) {
    if (!std::isfinite(error.value_m) || !std::isfinite(error.noise_m)) continue;
    sizes_m.push_back(std::abs(error.value_m));
    noises_m.push_back(std::abs(error.noise_m));
  }
  if (sizes_m.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double with_m = Quantile(std::move(sizes_m), fraction);
  const double noise_m = Quantile(std::move(noises_m), fraction);
  return std::sqrt(std::max(0.0, with_m * with_m - noise_m * noise_m));
}

}  // namespace foresight
