#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <span>

namespace foresight {

/// What a value on a grid is expected to be, from the values before it in its row and the row above
/// (docs/protocols.md): MED of LOCO-I at edges, and means of more neighbours where they differ by
/// less than `smooth`, since there the difference is noise, of which a mean has less.
class GridPredictor {
 public:
  explicit GridPredictor(int smooth) : smooth_(smooth) {}

  /// `above` may be shorter or longer than `row`, of which the first `at` values are known.
  template <class T>
  int Predict(std::span<const T> above, const T* row, std::size_t at) const {
    if (at >= above.size()) return AlongTheRow(row, at);
    const int up = above[at];
    if (at == 0) return up;
    const int left = row[at - 1], up_left = above[at - 1];
    const int up_right = at + 1 < above.size() ? above[at + 1] : up;
    const auto [low, high] = std::minmax({left, up, up_left, up_right});
    if (high - low < smooth_) return (3 * left + 3 * up + up_right + up_left + 4) / 8;
    if (high - low < 3 * smooth_) return (2 * left + 2 * up + up_right - up_left + 2) / 4;
    if (up_left >= std::max(left, up)) return std::min(left, up);
    if (up_left <= std::min(left, up)) return std::max(left, up);
    return left + up - up_left;
  }

 private:
  template <class T>
  int AlongTheRow(const T* row, std::size_t at) const {
    if (at == 0) return 0;
    const int left = row[at - 1];
    if (at == 1) return left;
    const int before = row[at - 2];
    return std::abs(left - before) < smooth_ ? (3 * left + before + 2) / 4 : left;
  }

  int smooth_;
};

}  // namespace foresight
