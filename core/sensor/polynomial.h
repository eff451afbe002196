#pragma once

#include <span>
#include <vector>

namespace foresight {

/// The value of c[0] + c[1] x + c[2] x^2 + ...
double PolynomialAt(std::span<const double> coefficients, double x);

/// Where the polynomial changes between positive and not, in (0, limit), ascending; each the last
/// double before the change. Between the changes of its derivative a polynomial grows or falls all
/// the way, so none is missed but a pair that rounding hides.
std::vector<double> SignChanges(std::span<const double> coefficients, double limit);

}  // namespace foresight
