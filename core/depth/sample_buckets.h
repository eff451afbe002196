#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/depth/aligned_samples.h"

namespace foresight {

/// The kept samples of an image, sorted into coarse squares of pixels, to find those in a
/// rectangle.
class SampleBuckets {
 public:
  /// O(samples + pixels / 64).
  explicit SampleBuckets(const AlignedSamples& samples);

  /// Calls visit(index) for each kept sample with left <= u <= right and top <= v <= bottom, and
  /// for some around.
  template <class Visit>
  void ForEachNear(float left, float top, float right, float bottom, const Visit& visit) const {
    const int first_column = Place(left, columns_);
    const int last_column = Place(right, columns_);
    const int last_row = Place(bottom, rows_);
    for (int row = Place(top, rows_); row <= last_row; ++row) {
      const auto from = static_cast<std::size_t>(first_[Index(first_column, row)]);
      const auto to = static_cast<std::size_t>(first_[Index(last_column, row) + 1]);
      for (std::size_t i = from; i < to; ++i) visit(static_cast<std::size_t>(sorted_[i]));
    }
  }

 private:
  /// The widest side of a bucket, for sparse samples.
  static constexpr int kWidest_px = 8;

  int Place(float coordinate, int count) const {
    return std::clamp(static_cast<int>((coordinate + 0.5f) / static_cast<float>(side_px_)), 0,
                      count - 1);
  }
  std::size_t Index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

  int side_px_;  ///< a cell of the lidar's grid touches a few, a bucket holds about one sample
  int columns_;
  int rows_;
  std::vector<std::int32_t> first_;   ///< a bucket's are sorted_[first_[b]] .. first_[b + 1]
  std::vector<std::int32_t> sorted_;  ///< indices of samples
};

}  // namespace foresight
