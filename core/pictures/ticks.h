#pragma once

#include <string>
#include <vector>

namespace foresight {

/// Round values for an axis.
struct Ticks {
  std::vector<double> values;       ///< ascending
  std::vector<std::string> labels;  ///< one a value, with just the decimals that tell them apart
};

/// The multiples of 1, 2 or 5 times a power of ten within [low, high], about `count` of them.
/// @param least_step no finer steps; 1 = whole numbers only. low < high, both finite.
Ticks LinearTicks(double low, double high, int count, double least_step = 0.0);

/// The powers of ten within [low, high], both positive; with fewer than three decades also 2 and 5
/// times them.
Ticks LogarithmicTicks(double low, double high);

}  // namespace foresight
