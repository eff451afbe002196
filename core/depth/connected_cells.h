#pragma once

#include <span>

#include "core/depth/row_set.h"
#include "core/depth/sample_planes.h"

namespace foresight {

/// Pixels inside those cells of the lidar's grid that lie on one surface: corners within
/// `tolerance_m` of each other in depth, or of each other's planes. A cell that the camera sees
/// three times as wide or as high as the samples' spacing is torn: its inside was not measured.
/// 255 = inside, edges included. O(pixels in cells).
Result<MaskImage> InsideConnectedCells(const SparseDepthMap& map, const AlignedSamples& samples,
                                       std::span<const SamplePlane> planes,
                                       const SampleSpacing& spacing, double tolerance_m,
                                       const RunContext& context);

/// Brings `inside`, once made by InsideConnectedCells of other samples or planes, up to date.
/// `changed` are the rows of all samples that came, went or have another plane; no cell that holds
/// together reaches further than three spacings from its corners. O(samples, and pixels in cells
/// near these rows).
Status UpdateConnectedCells(const SparseDepthMap& map, const AlignedSamples& samples,
                            std::span<const SamplePlane> planes, const SampleSpacing& spacing,
                            double tolerance_m, const RowSet& changed, MaskImage& inside,
                            const RunContext& context);

}  // namespace foresight
