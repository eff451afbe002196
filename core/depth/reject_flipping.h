#pragma once

#include "core/depth/aligned_samples.h"

namespace foresight {

/// Section IV-B and Fig. 4, and the visible surface as the better test where objects are wider than
/// a cell.
struct FlippingPointOptions {
  enum class Test {
    kOff,
    kCells,  ///< behind all four corners of a cell that it lies in, as printed
    kMesh,   ///< behind the surface through connected cells, at the sample's own place
  };
  enum class Cells {
    kFromKeptSamples,  ///< Eq. (7) comes before the cells are formed and breaks some; as printed
    kFromAllSamples,   ///< Eq. (7) comes after: its rejected samples still span cells
  };
  Test test = Test::kCells;
  Cells cells = Cells::kFromKeptSamples;
  double margin_m = 0.0;  ///< how much further behind an invader must be; printed: 0
  /// kMesh: corners whose depths differ by more do not belong to one surface.
  double connected_step_m = 0.10;

  Status Check() const;
};

/// Forms the 4-connected cells of the lidar's grid, sees them from the camera, and marks a kept
/// sample that lies in another cell (edges included) and behind it as kFlipping. The mesh is two
/// triangles a connected cell, depth linear in its inverse (a plane in space); a sample is compared
/// with the triangle itself, so no z-buffer rounds its place. An object one sample wide has no
/// connected cell: only kCells sees it. Fails with kCancelled. O(samples * samples per cell).
Status RejectFlipping(AlignedSamples& samples, const FlippingPointOptions& options,
                      const RunContext& context);

}  // namespace foresight
