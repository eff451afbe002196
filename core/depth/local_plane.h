#pragma once

#include "core/depth/upsample.h"

namespace foresight {

/// Foresight's own upsampling: where Eq. (8) averages depths, this fits a plane to the inverse
/// depths over the rays (exact for planes in space, whatever the lens), guided by CIELAB colour.
/// First each sample finds the plane of its own neighbourhood, from several slopes; a pixel then
/// starts from the plane of the best supported sample near it in place and colour. Defaults were
/// chosen on seven Middlebury scenes; docs/evaluation/depth.md.
struct LocalPlaneOptions {
  double sigma_spatial_px = 0.0;  ///< 0 = 0.6 of the paper's sigma_s for the density, 12 px at 2 %
  double radius_in_sigmas = 2.0;  ///< Omega
  double sigma_color = 12.0;      ///< CIELAB units
  double sigma_depth_m = 0.018;   ///< of the distance to the plane
  double ridge = 0.02;            ///< on the slopes, of sigma_s^2
  int iterations = 2;             ///< passes of each pixel, after its start
  bool keep_iterations = false;
  double along_line_px = 0.0;  ///< spacing of the samples; 0 = measured
  double between_lines_px = 0.0;

  Status Check() const;
};

/// sigma_s where the options leave it to the density: planes need a smaller window than averages.
double LocalPlaneSigmaForDensity(double density);

/// Upsamples with local planes. The confidence is the probability that a pixel's depth is right,
/// within 50 mm or 1 %, absolute, in [0, 1] (max_confidence = 1); 0 without a depth. It knows how
/// many samples agree with the pixel's plane against what the spacing promises and against those
/// that do not, how near the nearest one is in cells of the lidar's grid, whether there is one on
/// each side, and whether the pixel lies inside a cell on one surface: a hole behind an edge has
/// its samples all on one side and too far away. Fails as UpsampleDepth does.
Result<DenseDepth> UpsampleLocalPlanes(const AlignedSamples& samples, const ColorImage& guide,
                                       const LocalPlaneOptions& options, const RunContext& context);

}  // namespace foresight
