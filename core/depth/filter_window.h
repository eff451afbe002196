#pragma once

#include <cstdint>
#include <vector>

#include "core/depth/aligned_samples.h"

namespace foresight {

/// The kept samples of an image sorted by pixel, so that those of a stretch of one row are
/// contiguous. A sample counts for the pixel nearest to it, as in the paper's sparse map R; several
/// may share one.
class SparseDepthMap {
 public:
  SparseDepthMap(const AlignedSamples& samples, const GrayImage& guide);

  struct Entry {
    std::int32_t x = 0;
    float depth_m = 0.0f;
    std::int32_t intensity = 0;  ///< of the guide at the sample's pixel
  };

  int width() const { return width_; }
  int height() const { return height_; }
  std::size_t size() const { return entries_.size(); }

  /// The samples of row y with left <= x <= right; the range is cut to the image.
  const Entry* Begin(int y, int left) const {
    return entries_.data() + first_[Offset(y, left < 0 ? 0 : left)];
  }
  const Entry* End(int y, int right) const {
    return entries_.data() + first_[Offset(y, right >= width_ ? width_ - 1 : right) + 1];
  }

 private:
  std::size_t Offset(int y, int x) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }

  int width_;
  int height_;
  std::vector<std::int32_t> first_;  ///< one a pixel and one behind the last
  std::vector<Entry> entries_;
};

/// Omega and G of Eq. (8): a disc of integer offsets with the Gaussian of their distance.
class SpatialKernel {
 public:
  SpatialKernel(double sigma_px, double radius_px);

  int radius() const { return radius_; }
  /// Half width of the disc in the row `dy` away from its centre.
  int HalfWidth(int dy) const { return half_width_[static_cast<std::size_t>(dy + radius_)]; }
  /// G for an offset inside the disc.
  float Weight(int dx, int dy) const { return Row(dy)[dx]; }
  /// G of a row of the disc, indexed by dx in [-HalfWidth, HalfWidth].
  const float* Row(int dy) const {
    return weights_.data() +
           static_cast<std::size_t>(dy + radius_) * static_cast<std::size_t>(2 * radius_ + 1) +
           static_cast<std::size_t>(radius_);
  }

 private:
  int radius_;
  std::vector<int> half_width_;
  std::vector<float> weights_;
};

}  // namespace foresight
