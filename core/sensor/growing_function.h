#pragma once

#include <cmath>

namespace foresight {

/// The x in [low, high] at which a growing function has the value `wanted`: Newton's steps from
/// `start`, each kept inside the bracket that the values seen so far leave.
/// @param function x -> {value, derivative}; value(low) <= wanted <= value(high).
template <class Function>
double SolveGrowing(const Function& function, double wanted, double low, double high,
                    double start) {
  double x = std::fmin(std::fmax(start, low), high);
  for (int i = 0; i < 200; ++i) {
    const auto [value, slope] = function(x);
    const double error = value - wanted;
    const double newton = x - error / slope;
    if (error == 0.0 || newton == x) return x;
    (error > 0.0 ? high : low) = x;
    const bool inside = newton > low && newton < high;
    // Newton's steps shrink quadratically: after one of 1e-9 the next is below the last digit.
    if (inside && std::abs(newton - x) <= 1e-9 * std::abs(x)) return newton;
    const double next = inside ? newton : low + 0.5 * (high - low);
    if (next == low || next == high) return x;
    x = next;
  }
  return x;
}

}  // namespace foresight
