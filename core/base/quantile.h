#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace foresight {

/// The value below which `fraction` of the values lie, 0 <= fraction <= 1: that at rank
/// fraction (n - 1) of the sorted ones, between two of them in proportion. NaN where there is none.
/// O(n).
inline double Quantile(std::vector<double> values, double fraction) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double rank = fraction * static_cast<double>(values.size() - 1);
  const auto low = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), low, values.end());
  if (low + 1 == values.end()) return *low;
  return *low + (rank - std::floor(rank)) * (*std::min_element(low + 1, values.end()) - *low);
}

/// The value at rank n / 2 of the sorted ones: one of the values, of two middle ones the upper. NaN
/// where there is none. O(n).
template <class Value>
Value UpperMedian(std::vector<Value> values) {
  if (values.empty()) return std::numeric_limits<Value>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace foresight
