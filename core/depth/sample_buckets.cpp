#include "core/depth/sample_buckets.h"

#include <cmath>

namespace foresight {

SampleBuckets::SampleBuckets(const AlignedSamples& samples)
    : side_px_(std::clamp(static_cast<int>(std::sqrt(1.0 / std::max(1e-6, samples.Density()))), 2,
                          kWidest_px)),
      columns_((samples.width + side_px_ - 1) / side_px_),
      rows_((samples.height + side_px_ - 1) / side_px_),
      first_(Index(0, rows_) + 1, 0) {
  const auto bucket = [&](const AlignedSample& s) {
    return Index(Place(s.u, columns_), Place(s.v, rows_));
  };
  for (std::size_t i = 0; i < samples.samples.size(); ++i)
    if (samples.reasons[i] == RejectReason::kKept) ++first_[bucket(samples.samples[i]) + 1];
  for (std::size_t b = 1; b < first_.size(); ++b) first_[b] += first_[b - 1];
  sorted_.resize(static_cast<std::size_t>(first_.back()));
  std::vector<std::int32_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < samples.samples.size(); ++i)
    if (samples.reasons[i] == RejectReason::kKept)
      sorted_[static_cast<std::size_t>(next[bucket(samples.samples[i])]++)] =
          static_cast<std::int32_t>(i);
}

}  // namespace foresight
