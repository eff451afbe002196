#include "core/depth/filter_window.h"

#include <algorithm>
#include <cmath>

namespace foresight {

SparseDepthMap::SparseDepthMap(const AlignedSamples& samples, const GrayImage& guide)
    : width_(guide.width()), height_(guide.height()), first_(guide.size() + 1, 0) {
  const auto clamp = [](float coordinate, int size) {
    return std::clamp(static_cast<int>(std::lround(coordinate)), 0, size - 1);
  };
  const auto offset = [&](const AlignedSample& s) {
    return Offset(clamp(s.v, height_), clamp(s.u, width_));
  };
  for (std::size_t i = 0; i < samples.samples.size(); ++i)
    if (samples.reasons[i] == RejectReason::kKept) ++first_[offset(samples.samples[i]) + 1];
  for (std::size_t p = 1; p < first_.size(); ++p) first_[p] += first_[p - 1];
  entries_.resize(static_cast<std::size_t>(first_.back()));
  std::vector<std::int32_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < samples.samples.size(); ++i) {
    if (samples.reasons[i] != RejectReason::kKept) continue;
    const AlignedSample& s = samples.samples[i];
    const int x = clamp(s.u, width_);
    const int y = clamp(s.v, height_);
    entries_[static_cast<std::size_t>(next[Offset(y, x)]++)] = {x, s.depth_m, guide(x, y)};
  }
}

SpatialKernel::SpatialKernel(double sigma_px, double radius_px)
    : radius_(static_cast<int>(std::floor(radius_px + 1e-9))) {
  const int side = 2 * radius_ + 1;
  weights_.assign(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 0.0f);
  for (int dy = -radius_; dy <= radius_; ++dy) {
    half_width_.push_back(
        static_cast<int>(std::floor(std::sqrt(radius_px * radius_px - dy * dy) + 1e-9)));
    for (int dx = -half_width_.back(); dx <= half_width_.back(); ++dx)
      weights_[static_cast<std::size_t>(dy + radius_) * static_cast<std::size_t>(side) +
               static_cast<std::size_t>(dx + radius_)] =
          static_cast<float>(std::exp(-(dx * dx + dy * dy) / (2.0 * sigma_px * sigma_px)));
  }
}

}  // namespace foresight
