#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/image.h"

namespace foresight {

struct AlignedSamples;

/// The kept samples of an image, row by row, from left to right. A sample counts for the pixel
/// nearest to it, as in the paper's sparse map R; several may share one. Free of Eigen, for the
/// vector kernels' sake.
class SparseDepthMap {
 public:
  explicit SparseDepthMap(const AlignedSamples& samples);

  int width() const { return width_; }
  int height() const { return static_cast<int>(first_.size()) - 1; }
  std::size_t size() const { return depths_m_.size(); }

  /// The samples of the rows top <= y < bottom are those at First(top) <= i < First(bottom).
  std::int32_t First(int row) const { return first_[static_cast<std::size_t>(row)]; }
  std::span<const std::int32_t> columns() const { return columns_; }
  std::span<const std::int32_t> rows() const { return rows_; }
  std::span<const float> depths_m() const { return depths_m_; }
  /// Index of each into AlignedSamples::samples.
  std::span<const std::int32_t> sources() const { return sources_; }

  /// What an image of the same size holds at each sample's pixel.
  template <class T>
  std::vector<float> ValuesAt(const Image<T>& image) const {
    std::vector<float> values(size());
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = static_cast<float>(image(columns_[i], rows_[i]));
    return values;
  }

 private:
  int width_;
  std::vector<std::int32_t> first_;  ///< one a row and one behind the last
  std::vector<std::int32_t> columns_;
  std::vector<std::int32_t> rows_;
  std::vector<float> depths_m_;
  std::vector<std::int32_t> sources_;
};

/// Omega and G of Eq. (8): a disc of integer offsets with the Gaussian of their distance, in a
/// table with a margin of zeros, so that a register that sticks out of the disc can be read from
/// it.
class SpatialKernel {
 public:
  static constexpr int kMargin = 16;  ///< the widest register holds 16 floats

  SpatialKernel(double sigma_px, double radius_px);

  int radius() const { return radius_; }
  /// G at the offset (dx, dy) is Centre()[dy * stride() + dx], for |dx|, |dy| <= radius + kMargin.
  const float* Centre() const {
    return weights_.data() + static_cast<std::ptrdiff_t>(radius_ + kMargin) * (stride() + 1);
  }
  std::ptrdiff_t stride() const { return 2 * (radius_ + kMargin) + 1; }

 private:
  int radius_;
  std::vector<float> weights_;
};

}  // namespace foresight
