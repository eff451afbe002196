#pragma once

#include <span>

namespace foresight {

/// A difference that was measured with noise, and a draw of that noise.
struct NoisyError {
  double value_m = 0.0;
  double noise_m = 0.0;  ///< spreads as the noise in value_m does, and is independent of it
};

/// The size that `fraction` of the errors stay below, without the noise: squares of quantiles
/// subtract, sqrt(q(|value|)^2 - q(|noise|)^2). Exact where errors and noise are normal, and near
/// it where the errors are much larger than the noise. 0 where the noise explains all; NaN without
/// errors. Errors that are not finite are left out. 0 < fraction < 1. O(errors).
double QuantileWithoutNoise(std::span<const NoisyError> errors, double fraction);

}  // namespace foresight
