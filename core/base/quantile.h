#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/contract.h"

namespace foresight {

/// The value below which `fraction` of the values lie, 0 <= fraction <= 1: that at rank
/// fraction (n - 1) of the sorted ones, between two of them in proportion. NaN where there is none.
/// O(n).
template <class Value = double>
Value Quantile(std::vector<Value> values, double fraction) {
  if (values.empty()) return std::numeric_limits<Value>::quiet_NaN();
  const double rank = fraction * static_cast<double>(values.size() - 1);
  const auto low = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), low, values.end());
  if (low + 1 == values.end()) return *low;
  return static_cast<Value>(*low + (rank - std::floor(rank)) *
                                       (*std::min_element(low + 1, values.end()) - *low));
}

/// The value at `rank` of the sorted ones, from 0: one of the values, for those who count otherwise
/// than Quantile does. Changes the order of the values. O(n).
template <class Value>
Value MoveToRank(std::vector<Value>& values, std::size_t rank) {
  FORESIGHT_EXPECTS(rank < values.size(), "a rank below the number of values");
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// The same, and leaves the caller's values as they are.
template <class Value>
Value ValueAtRank(std::vector<Value> values, std::size_t rank) {
  return MoveToRank(values, rank);
}

/// The value at rank n / 2 of the sorted ones: one of the values, of two middle ones the upper. NaN
/// where there is none. O(n).
template <class Value>
Value UpperMedian(std::vector<Value> values) {
  if (values.empty()) return std::numeric_limits<Value>::quiet_NaN();
  const std::size_t middle = values.size() / 2;
  return ValueAtRank(std::move(values), middle);
}

}  // namespace foresight
