#include "core/sensor/polynomial.h"

#include <algorithm>

namespace foresight {

double PolynomialAt(std::span<const double> coefficients, double x) {
  double value = 0.0;
  for (auto c = coefficients.rbegin(); c != coefficients.rend(); ++c) value = value * x + *c;
  return value;
}

std::vector<double> SignChanges(std::span<const double> coefficients, double limit) {
  const auto below = [](double c) { return c < 0.0; };
  const auto above = [](double c) { return c > 0.0; };
  // Descartes: without two signs among the coefficients there is no change.
  if (std::none_of(coefficients.begin(), coefficients.end(), below) ||
      std::none_of(coefficients.begin(), coefficients.end(), above))
    return {};
  std::vector<double> derivative;
  for (std::size_t i = 1; i < coefficients.size(); ++i)
    derivative.push_back(static_cast<double>(i) * coefficients[i]);
  std::vector<double> ends = SignChanges(derivative, limit);
  ends.push_back(limit);

  std::vector<double> changes;
  double begin = 0.0;
  for (const double end : ends) {
    const bool positive = PolynomialAt(coefficients, begin) > 0.0;
    if ((PolynomialAt(coefficients, end) > 0.0) != positive) {
      double low = begin, high = end;
      for (;;) {
        const double middle = low + 0.5 * (high - low);
        if (!(middle > low && middle < high)) break;
        ((PolynomialAt(coefficients, middle) > 0.0) == positive ? low : high) = middle;
      }
      changes.push_back(low);
    }
    begin = end;
  }
  return changes;
}

}  // namespace foresight
