#include "core/depth/filter_window.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "core/depth/aligned_samples.h"

namespace foresight {
namespace {

/// Sorts one row's columns upwards, and its depths along with them.
void SortByColumn(std::span<std::int32_t> columns, std::span<float> depths_m) {
  if (std::is_sorted(columns.begin(), columns.end())) return;
  std::vector<std::pair<std::int32_t, float>> entries;
  for (std::size_t i = 0; i < columns.size(); ++i) entries.emplace_back(columns[i], depths_m[i]);
  std::stable_sort(entries.begin(), entries.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t i = 0; i < columns.size(); ++i) std::tie(columns[i], depths_m[i]) = entries[i];
}

}  // namespace

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
  columns_.resize(count);
  rows_.resize(count);
  depths_m_.resize(count);
  std::vector<std::int32_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < samples.samples.size(); ++i) {
    if (samples.reasons[i] != RejectReason::kKept) continue;
    const AlignedSample& s = samples.samples[i];
    const std::size_t row = row_of(s);
    const auto place = static_cast<std::size_t>(next[row]++);
    columns_[place] = pixel(s.u, samples.width);
    rows_[place] = static_cast<std::int32_t>(row);
    depths_m_[place] = s.depth_m;
  }
  for (int row = 0; row < samples.height; ++row) {
    const auto from = static_cast<std::size_t>(First(row));
    const std::size_t in_row = static_cast<std::size_t>(First(row + 1)) - from;
    SortByColumn(std::span(columns_).subspan(from, in_row),
                 std::span(depths_m_).subspan(from, in_row));
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
