#include "core/depth/sample_buckets.h"

namespace foresight {

SampleBuckets::SampleBuckets(const AlignedSamples& samples)
    : columns_((samples.width + kBucketPx - 1) / kBucketPx),
      rows_((samples.height + kBucketPx - 1) / kBucketPx),
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
