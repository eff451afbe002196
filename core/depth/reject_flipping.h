#pragma once

#include "core/depth/aligned_samples.h"

namespace foresight {

/// Section IV-B and Fig. 4.
struct FlippingPointOptions {
  bool enabled = true;
  double margin_m = 0.0;  ///< how much further than all four corners an invader must be; printed: 0
  /// Cells from the samples still kept (as Section IV prints the order) or from all of them.
  bool cells_from_kept_only = true;

  Status Check() const;
};

/// Forms the 4-connected cells of the lidar's grid, sees them from the camera, and marks a kept
/// sample that lies in another cell (edges included) and behind all four of its corners as
/// kFlipping. O(samples * samples per cell).
Status RejectFlipping(AlignedSamples& samples, const FlippingPointOptions& options,
                      const RunContext& context);

}  // namespace foresight
