#pragma once

#include "core/depth/aligned_samples.h"

namespace foresight {

/// The threshold that neighbours are compared with is
///   threshold_m + (threshold_per_metre + threshold_per_step * step) * depth,
/// step = how far the rays of neighbouring beams are apart at 1 m (du / f; the median over the
/// image's samples). The defaults are Eq. (7) as printed.
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
  double threshold_per_metre = 0.0;  ///< of depth
  double threshold_per_step = 0.0;   ///< slope that a surface may have between neighbouring beams

  /// max() on the difference of depth with T = 30 mm + 2 z du / f: spares surfaces up to a slope of
  /// about 2 at any range. Samples without 3D points (imported without a camera) have no steps; for
  /// them T is 30 mm.
  static FlyingPointOptions RangeAdaptive();

  Status Check() const;
};

/// Marks flying points, Eq. (7), one scan line at a time: a sample whose neighbours on its line are
/// further away than the threshold becomes kFlying. Neighbours without a measurement do not vote.
/// Whether Fig. 4's cells may still use the marked samples is FlippingPointOptions::cells.
/// O(samples).
Status RejectFlying(AlignedSamples& samples, const FlyingPointOptions& options);

}  // namespace foresight
