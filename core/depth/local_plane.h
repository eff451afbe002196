#pragma once

#include "core/depth/upsample.h"

namespace foresight {

/// Foresight's own upsampling: where Eq. (8) averages depths, this fits a plane to the inverse
/// depths (exact for planes in space), guided by CIELAB colour, started at the sample that is
/// nearest in place and colour. Defaults were chosen on seven Middlebury scenes;
/// docs/evaluation.md.
struct LocalPlaneOptions {
  double sigma_spatial_px = 0.0;  ///< 0 = 0.6 of the paper's sigma_s for the density, 12 px at 2 %
  double radius_in_sigmas = 2.0;  ///< Omega
  double sigma_color = 18.0;      ///< CIELAB units
  double sigma_depth_m = 0.024;   ///< of the distance to the plane
  double ridge = 0.02;            ///< on the slopes, of sigma_s^2
  int iterations = 3;
  bool keep_iterations = false;
  double along_line_px = 0.0;  ///< spacing of the samples; 0 = measured
  double between_lines_px = 0.0;

  Status Check() const;
};

/// Upsamples with local planes. The confidence is the probability that a pixel was really seen by
/// the lidar, absolute, in [0, 1] (max_confidence = 1); 0 without a depth. It looks at the samples
/// that agree with the pixel's plane: how many there are against what the spacing promises, how
/// near the nearest one is in cells of the lidar's grid, and whether there is one on each side: a
/// hole behind an edge has its samples all on one side and too far away. Fails as UpsampleDepth
/// does.
Result<DenseDepth> UpsampleLocalPlanes(const AlignedSamples& samples, const ColorImage& guide,
                                       const LocalPlaneOptions& options, const RunContext& context);

}  // namespace foresight
