#include "core/depth/changed_samples.h"

#include <cstring>

namespace foresight {
namespace {

bool SameSample(const AlignedSample& a, const AlignedSample& b) {
  static_assert(sizeof(AlignedSample) == 8 * 4, "no padding, so equal samples have equal bytes");
  return std::memcmp(&a, &b, sizeof(AlignedSample)) == 0;
}

}  // namespace

SampleChange CompareSamples(const MappedSamples& before, const MappedSamples& now) {
  SampleChange change{std::vector<std::int32_t>(now.map.size(), -1), RowSet(now.map.height())};
  std::vector<std::int32_t> place(before.samples.samples.size(), -1);
  for (std::size_t p = 0; p < before.map.size(); ++p)
    place[static_cast<std::size_t>(before.map.sources()[p])] = static_cast<std::int32_t>(p);
  std::vector<bool> stayed(before.map.size(), false);
  for (std::size_t q = 0; q < now.map.size(); ++q) {
    const auto source = static_cast<std::size_t>(now.map.sources()[q]);
    const std::int32_t p = source < place.size() ? place[source] : -1;
    if (p >= 0 && SameSample(before.samples.samples[source], now.samples.samples[source])) {
      change.before[q] = p;
      stayed[static_cast<std::size_t>(p)] = true;
    } else {
      change.rows.Add(now.map.rows()[q]);
    }
  }
  for (std::size_t p = 0; p < before.map.size(); ++p)
    if (!stayed[p]) change.rows.Add(before.map.rows()[p]);
  return change;
}

SampleChange EverythingNew(const MappedSamples& now) {
  return {std::vector<std::int32_t>(now.map.size(), -1), RowSet(now.map.height(), true)};
}

}  // namespace foresight
