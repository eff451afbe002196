#include "core/depth/filter_scratch.h"

#include <algorithm>

namespace foresight {
namespace {
constexpr std::size_t kRegister = SpatialKernel::kMargin;
}

float* AlignedFloats::Require(std::size_t count) {
  if (count > capacity_) {
    capacity_ = std::max(count, 2 * capacity_);
    floats_ = hwy::AllocateAligned<float>(capacity_);
  }
  return floats_.get();
}

void PaddedRows::Reset(int planes, int rows, int width) {
  const std::size_t stride =
      (static_cast<std::size_t>(width) + 2 * kRegister - 1) / kRegister * kRegister;
  const std::size_t size = static_cast<std::size_t>(planes * rows) * stride;
  stride_ = static_cast<std::ptrdiff_t>(stride);
  rows_ = rows;
  std::fill_n(floats_.Require(size), size, 0.0f);
}

void SampleBand::Load(const SparseDepthMap& samples, int top, int bottom) {
  const std::int32_t begin = samples.First(std::clamp(top, 0, samples.height()));
  const std::int32_t end = samples.First(std::clamp(bottom, 0, samples.height()));
  size_ = static_cast<std::size_t>(end - begin);
  x_.resize(size_ + kRegister);
  y_.resize(size_ + kRegister);
  index_.resize(size_ + kRegister);
  // A counting sort by column. first_ is shifted by one while it counts, so that filling the places
  // leaves it as it is wanted.
  first_.assign(static_cast<std::size_t>(samples.width()) + 2, 0);
  const auto slot = [&](std::int32_t i) {
    return static_cast<std::size_t>(samples.columns()[static_cast<std::size_t>(i)]);
  };
  for (std::int32_t i = begin; i < end; ++i) ++first_[slot(i) + 2];
  for (std::size_t c = 2; c < first_.size(); ++c) first_[c] += first_[c - 1];
  for (std::int32_t i = begin; i < end; ++i) {
    const auto place = static_cast<std::size_t>(first_[slot(i) + 1]++);
    x_[place] = static_cast<float>(slot(i));
    y_[place] = static_cast<float>(samples.rows()[static_cast<std::size_t>(i)]);
    index_[place] = i;
  }
}

std::size_t SampleBand::First(int column) const {
  const int last = static_cast<int>(first_.size()) - 2;
  return static_cast<std::size_t>(first_[static_cast<std::size_t>(std::clamp(column, 0, last))]);
}

}  // namespace foresight
