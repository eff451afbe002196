#pragma once

#include <algorithm>
#include <vector>

#include "core/base/random.h"
#include "core/fitting/ray_set.h"

namespace foresight {

/// `count` of the values, drawn at random; all of them, in their order, where there are no more.
template <class T>
std::vector<T> RandomSubset(std::vector<T> values, int count, Random& random) {
  if (std::ssize(values) <= count) return values;
  for (int i = 0; i < count; ++i)
    std::swap(values[static_cast<std::size_t>(i)],
              values[static_cast<std::size_t>(i) +
                     random.Index(static_cast<int>(std::ssize(values)) - i)]);
  values.resize(static_cast<std::size_t>(count));
  return values;
}

/// At most `count` rays; each then stands for more of a dense map's measurements.
RaySet Thinned(const RaySet& rays, int count, Random& random);

/// What the beams alone say.
RaySet WithoutImage(RaySet rays);

/// Fails with kInvalidInput for a noise, footprint, weight or viewpoint that is no use.
Status CheckRayNoise(const RaySet& rays);

/// The rays that are finite and have a range; the rest as it is. Fails with kInvalidInput for a
/// noise, footprint, weight or viewpoint that is no use, and with kTooFewPoints for fewer than
/// `least` rays, saying that `object` needs them: "a wheel".
Result<RaySet> UsableRays(const RaySet& rays, int least, const char* object);

/// The beams behind a dense map that are usable, thinned; null where there are fewer than `least`.
std::shared_ptr<const RaySet> ThinnedBeams(const RaySet& rays, int count, int least,
                                           Random& random);

}  // namespace foresight
