#pragma once

#include <cstdint>
#include <vector>

#include "core/depth/aligned_samples.h"
#include "core/depth/filter_window.h"
#include "core/depth/row_set.h"

namespace foresight {

/// Samples with their sparse map.
struct MappedSamples {
  AlignedSamples samples;
  SparseDepthMap map;

  explicit MappedSamples(const AlignedSamples& from) : samples(from), map(samples) {}
};

/// What tells the samples of a moment from those of an earlier one.
struct SampleChange {
  std::vector<std::int32_t> before;  ///< each sample's index in the earlier map; -1 = new or moved
  RowSet rows;  ///< of samples that came, were rejected, are kept again or moved (both rows)
};

/// Samples are the same where they stand at the same place in AlignedSamples::samples and are equal
/// in every bit: lines that arrive are appended. The order of the same ones never differs between
/// the two maps. O(samples).
SampleChange CompareSamples(const MappedSamples& before, const MappedSamples& now);

/// As if there had been nothing before: every row changed, also those without samples.
SampleChange EverythingNew(const MappedSamples& now);

}  // namespace foresight
