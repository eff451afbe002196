#pragma once

#include <cmath>

namespace foresight {

/// Tukey's biweight of a residual over the residual from which on it counts for nothing: 1 at 0, 0
/// from 1 on, whichever the sign; 0 for NaN.
inline double TukeyWeight(double off) {
  return std::abs(off) < 1.0 ? std::pow(1.0 - off * off, 2) : 0.0;
}

}  // namespace foresight
