#pragma once

#include "core/depth/aligned_samples.h"

namespace foresight {

struct FlyingPointOptions {
  enum class Rule {
    kOff,
    kAnyNeighbourFar,    ///< max(), as Eq. (7) prints it
    kBothNeighboursFar,  ///< min(): spares the edges of objects
  };
  enum class Distance {
    kEuclidean,  ///< 3D distance, as printed
    kDepth,      ///< difference of depth only: does not grow with range on a wall that faces us
  };
  Rule rule = Rule::kAnyNeighbourFar;
  Distance distance = Distance::kEuclidean;
  double threshold_m = 0.030;        ///< T_f, Section IV-A
  double threshold_per_metre = 0.0;  ///< added to the threshold for each metre of depth

  Status Check() const;
};

/// Marks flying points, Eq. (7), one scan line at a time: a sample whose neighbours on its line are
/// further away than the threshold becomes kFlying. Neighbours without a measurement do not vote.
/// O(samples).
Status RejectFlying(AlignedSamples& samples, const FlyingPointOptions& options);

}  // namespace foresight
