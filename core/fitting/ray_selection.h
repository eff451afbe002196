#pragma once

#include <algorithm>
#include <span>
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

/// The median of where rays end, in base, each coordinate by itself. @pre !rays.empty()
Eigen::Vector3d MedianPlace(std::span<const RangeRay> rays);

/// About where the thing is that a region was drawn round: the median place of the nearer half of
/// the rays in its middle. What is before it and behind it is left out. @pre !rays.rays.empty()
Eigen::Vector3d PlaceInMiddle(const RaySet& rays);

/// What was measured round a region, the beams behind a map where they are known; null = it is not
/// known.
const RaySet* SurroundingBeams(const RaySet& region);

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
