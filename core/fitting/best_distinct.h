#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace foresight {

/// Keeps the best few that differ from each other, the best first: one that is alike a better one
/// goes. `score` is a member or a function, higher is better; of equal ones the first stays first.
template <class T, class Score, class Alike>
void KeepBestDistinct(std::size_t most, const Score& score, const Alike& alike,
                      std::vector<T>& items) {
  std::stable_sort(items.begin(), items.end(), [&](const T& a, const T& b) {
    return std::invoke(score, a) > std::invoke(score, b);
  });
  std::vector<T> kept;
  for (const T& item : items) {
    if (kept.size() >= most) break;
    if (std::none_of(kept.begin(), kept.end(), [&](const T& other) { return alike(item, other); }))
      kept.push_back(item);
  }
  items = std::move(kept);
}

}  // namespace foresight
