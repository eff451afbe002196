#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/contract.h"

namespace foresight {

/// A rectangle of values, row by row, owned. Pixel (x, y) = (column, row); (0, 0) is the top left
/// one.
template <class T>
class Image {
 public:
  using Value = T;

  Image() = default;
  Image(int width, int height, T fill = T{}) : width_(width), height_(height) {
    FORESIGHT_EXPECTS(width >= 0 && height >= 0, "an image has no negative size");
    values_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), fill);
  }

  int width() const { return width_; }
  int height() const { return height_; }
  bool empty() const { return values_.empty(); }
  std::size_t size() const { return values_.size(); }
  template <class U>
  bool SameSize(const Image<U>& other) const {
    return width_ == other.width() && height_ == other.height();
  }
  bool Contains(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }

  T& operator()(int x, int y) { return values_[Offset(x, y)]; }
  const T& operator()(int x, int y) const { return values_[Offset(x, y)]; }
  T* row(int y) { return values_.data() + Offset(0, y); }
  const T* row(int y) const { return values_.data() + Offset(0, y); }
  std::span<T> values() { return values_; }
  std::span<const T> values() const { return values_; }
  T* data() { return values_.data(); }
  const T* data() const { return values_.data(); }

  bool operator==(const Image&) const = default;

 private:
  std::size_t Offset(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }

  int width_ = 0;
  int height_ = 0;
  std::vector<T> values_;
};

struct Rgb8 {
  std::uint8_t r = 0;
  std::uint8_t g = 0;
  std::uint8_t b = 0;
  bool operator==(const Rgb8&) const = default;
};

using ColorImage = Image<Rgb8>;
using GrayImage = Image<std::uint8_t>;
using FloatImage = Image<float>;        ///< NaN = no value
using DepthImage = FloatImage;          ///< metres along the camera's z axis; NaN = no depth
using MaskImage = Image<std::uint8_t>;  ///< 0 = masked out, 255 = kept

}  // namespace foresight
