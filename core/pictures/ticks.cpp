#include "core/pictures/ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/contract.h"

namespace foresight {
namespace {

/// A value on an edge counts as inside, whatever its last bit is.
constexpr double kSlack = 1e-9;

/// The smallest 1, 2 or 5 times a power of ten that is not below `step`.
double RoundStep(double step) {
  const double power = std::pow(10.0, std::floor(std::log10(step)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= step * (1.0 - kSlack)) return factor * power;
  return 10.0 * power;
}

std::string LogarithmicLabel(double value) {
  return value < 1e-3 || value > 9999.0 ? fmt::format("{:.0e}", value) : fmt::format("{:g}", value);
}

}  // namespace

Ticks LinearTicks(double low, double high, int count, double least_step) {
  FORESIGHT_EXPECTS(low < high && count >= 1, "an axis has a length");
  const double step = std::max(RoundStep((high - low) / count), least_step);
  const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + kSlack)));
  const double first = std::ceil(low / step - kSlack);
  const double last = std::floor(high / step + kSlack);
  Ticks ticks;
  for (double i = first; i <= last; i += 1.0) {
    const double value = i == 0.0 ? 0.0 : i * step;  // never "-0"
    ticks.values.push_back(value);
    ticks.labels.push_back(fmt::format("{:.{}f}", value, decimals));
  }
  return ticks;
}

Ticks LogarithmicTicks(double low, double high) {
  FORESIGHT_EXPECTS(0.0 < low && low < high, "a logarithmic axis has a positive length");
  const bool finer = std::log10(high / low) < 3.0;
  Ticks ticks;
  for (double decade = std::floor(std::log10(low)); decade <= std::ceil(std::log10(high)); ++decade)
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double value = factor * std::pow(10.0, decade);
      if (factor > 1.0 && !finer) continue;
      if (value < low * (1.0 - kSlack) || value > high * (1.0 + kSlack)) continue;
      ticks.values.push_back(value);
      ticks.labels.push_back(LogarithmicLabel(value));
    }
  return ticks;
}

}  // namespace foresight
