#include "core/depth/filter_window.h"

#include <algorithm>
#include <cmath>

#include "core/depth/aligned_samples.h"

namespace foresight {

SparseDepthMap::SparseDepthMap(const AlignedSamples& samples)
    : width_(samples.width), first_(static_cast<std::size_t>(samples.height) + 1, 0) {
  const auto pixel = [](float coordinate, int size) {
    return std::clamp(static_cast<int>(std::lround(coordinate)), 0, size - 1);
  };
  const auto row_of = [&](const AlignedSample& s) {
    return static_cast<std::size_t>(pixel(s.v, samples.height));
  };
  for (std::size_t i = 0; i < samples.samples.size(); ++i)
    if (samples.reasons[i] == RejectReason::kKept) ++first_[row_of(samples.samples[i]) + 1];
  for (std::size_t y = 1; y < first_.size(); ++y) first_[y] += first_[y - 1];
  const auto count = static_cast<std::size_t>(first_.back());
  sources_.resize(count);
  rows_.reserve(count);
  columns_.reserve(count);
  depths_m_.reserve(count);
  std::vector<std::int32_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < samples.samples.size(); ++i) {
    if (samples.reasons[i] != RejectReason::kKept) continue;
    const std::size_t row = row_of(samples.samples[i]);
    sources_[static_cast<std::size_t>(next[row]++)] = static_cast<std::int32_t>(i);
  }
  const auto column_of = [&](std::int32_t source) {
    return pixel(samples.samples[static_cast<std::size_t>(source)].u, samples.width);
  };
  for (int row = 0; row < samples.height; ++row) {
    const auto in_row =
        std::span(sources_).subspan(static_cast<std::size_t>(First(row)),
                                    static_cast<std::size_t>(First(row + 1) - First(row)));
    const auto left_of = [&](std::int32_t a, std::int32_t b) {
      return column_of(a) < column_of(b);
    };
    if (!std::is_sorted(in_row.begin(), in_row.end(), left_of))
      std::stable_sort(in_row.begin(), in_row.end(), left_of);
    rows_.insert(rows_.end(), in_row.size(), row);
  }
  for (const std::int32_t source : sources_) {
    columns_.push_back(column_of(source));
    depths_m_.push_back(samples.samples[static_cast<std::size_t>(source)].depth_m);
  }
}

SpatialKernel::SpatialKernel(double sigma_px, double radius_px)
    : radius_(static_cast<int>(std::floor(radius_px + 1e-9))) {
  weights_.assign(static_cast<std::size_t>(stride() * stride()), 0.0f);
  float* centre = weights_.data() + (Centre() - weights_.data());
  for (int dy = -radius_; dy <= radius_; ++dy)
    for (int dx = -radius_; dx <= radius_; ++dx) {
      const double distance2 = dx * dx + dy * dy;
      if (distance2 <= radius_px * radius_px + 1e-9)
        centre[dy * stride() + dx] =
            static_cast<float>(std::exp(-distance2 / (2.0 * sigma_px * sigma_px)));
    }
}

}  // namespace foresight
