#pragma once

#include <hwy/aligned_allocator.h>

#include <cstdint>
#include <span>
#include <vector>

#include "core/depth/filter_window.h"

namespace foresight {

/// Floats aligned for any register, not initialised; grows and never shrinks.
class AlignedFloats {
 public:
  /// Room for `count` floats; what was in it is lost when it grows.
  float* Require(std::size_t count);
  float* data() { return floats_.get(); }

 private:
  hwy::AlignedFreeUniquePtr<float[]> floats_;
  std::size_t capacity_ = 0;
};

/// A few planes of a few image rows each, padded so that a register may reach behind the last
/// pixel.
class PaddedRows {
 public:
  /// All values become zero.
  void Reset(int planes, int rows, int width);
  float* Row(int plane, int row) { return floats_.data() + (plane * rows_ + row) * stride_; }
  std::ptrdiff_t stride() const { return stride_; }

 private:
  AlignedFloats floats_;
  std::ptrdiff_t stride_ = 0;
  int rows_ = 0;
};

/// The samples that can reach a band of rows, from left to right (and from top to bottom within a
/// column): the samples of a rectangle then are one stretch, whatever the rectangle's width.
class SampleBand {
 public:
  /// Takes the samples of the rows top <= y < bottom; the rows are cut to the image.
  void Load(const SparseDepthMap& samples, int top, int bottom);

  /// The places with left <= x < right are First(left) <= i < First(right); cut to the image.
  std::size_t First(int column) const;
  const float* x() const { return x_.data(); }
  const float* y() const { return y_.data(); }
  /// Index into the SparseDepthMap. All three arrays are readable for one register behind the end.
  const std::int32_t* index() const { return index_.data(); }
  std::size_t size() const { return size_; }

 private:
  std::size_t size_ = 0;
  std::vector<std::int32_t> first_;
  std::vector<float> x_;
  std::vector<float> y_;
  std::vector<std::int32_t> index_;
};

}  // namespace foresight
