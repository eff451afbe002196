#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace foresight {

/// Some rows of an image: where something changed, or is to be done again.
class RowSet {
 public:
  explicit RowSet(int height, bool all = false)
      : in_(static_cast<std::size_t>(height), all ? 1 : 0) {}

  int height() const { return static_cast<int>(in_.size()); }
  void Add(int row) { in_[static_cast<std::size_t>(row)] = 1; }
  bool Contains(int row) const { return in_[static_cast<std::size_t>(row)] != 0; }

  RowSet& operator|=(const RowSet& other) {
    for (std::size_t y = 0; y < in_.size(); ++y) in_[y] |= other.in_[y];
    return *this;
  }

  /// These and all rows at most `reach` above or below one of them.
  RowSet GrownBy(int reach) const {
    RowSet grown(height());
    int done = 0;  // rows above are settled
    for (int y = 0; y < height(); ++y) {
      if (!Contains(y)) continue;
      for (done = std::max(done, y - reach); done < std::min(y + reach + 1, height()); ++done)
        grown.Add(done);
    }
    return grown;
  }

  /// Blocks of `rows` rows, counted from the top, that hold one of these.
  std::vector<int> Blocks(int rows) const {
    std::vector<int> blocks;
    for (int y = 0; y < height(); ++y)
      if (Contains(y) && (blocks.empty() || blocks.back() != y / rows)) blocks.push_back(y / rows);
    return blocks;
  }

 private:
  std::vector<std::uint8_t> in_;
};

}  // namespace foresight
