#pragma once

#include "core/depth/aligned_samples.h"

namespace foresight {

/// Section IV-A: "morphological operations in the image domain for removing isolated sparse
/// points". Each kept sample grows to a box of (du + grow_px) x (dv + grow_px) pixels, where du and
/// dv are the spacings of the samples; the union is opened with a box of (2 du + 1) x (2 dv + 1).
struct IsolatedPointOptions {
  bool enabled = true;
  int grow_px = 3;
  double along_line_px = 0.0;     ///< du; 0 = measured, see MeasureSpacing
  double between_lines_px = 0.0;  ///< dv; 0 = measured

  Status Check() const;
};

/// Marks kept samples that the opening removes as kIsolated. O(pixels + samples).
Status RejectIsolated(AlignedSamples& samples, const IsolatedPointOptions& options);

}  // namespace foresight
