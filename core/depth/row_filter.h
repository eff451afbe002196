#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/depth/filter_window.h"

namespace foresight {

/// Which passes Eq. (9) sums over, for n passes after D0.
enum class ConfidencePasses {
  kAll,         ///< G of the first pass, where H is omitted, and G H(D^0) .. G H(D^(n-1))
  kEveryDepth,  ///< G H(D^0) .. G H(D^n): one pass more, for the confidence alone
  kGuided,      ///< G H(D^0) .. G H(D^(n-1))
};

/// The filter of Eq. (8) and (9) over a block of rows, in the widest registers that the processor
/// has: neighbouring pixels side by side. Several threads may filter different rows at once.
struct JointFilter {
  const SparseDepthMap& samples;
  const SpatialKernel& spatial;
  const GrayImage& guide;                   ///< I, of the samples' size
  std::span<const float> sample_intensity;  ///< samples.ValuesAt(guide)
  float sigma_intensity = 20.0f;
  float sigma_depth_m = 0.030f;
  int iterations = 5;               ///< passes after D0
  bool literal_weights = false;     ///< exp(G + K + H) instead of G K H
  bool literal_confidence = false;  ///< exp(G + H) instead of G H
  ConfidencePasses confidence = ConfidencePasses::kAll;
};

/// Images of the guide's size; only the filtered rows are written.
struct JointFilterOutput {
  DepthImage& depth_m;               ///< NaN where D0 has no support
  FloatImage& confidence;            ///< 0 there
  std::span<DepthImage> iterations;  ///< D0 .. Dn, or empty
};

/// What Fig. 6(b) is made of.
struct FilterChange {
  std::span<double> sum_m;  ///< sum of |D(t+1) - D(t)|, one a pass after D0; is added to
  std::int64_t pixels = 0;  ///< that have a depth; is added to
};

/// Filters the rows top <= y < bottom. O(pixels * samples in Omega * passes).
void FilterRows(const JointFilter& filter, int top, int bottom, const JointFilterOutput& output,
                FilterChange& change);

/// The filter's first-order relative: fits rho = a + b dx + c dy to the samples' inverse depths, dx
/// and dy in pixels from the pixel. A plane in space is exactly that in a pinhole image.
///   G as above; K = exp(-|colour - colour of the sample|^2 / (2 sigma_c^2));
///   H = exp(-e^2 / (2 sigma_d^2)), e = (rho_q - rho(q)) R_q / rho(q): metres to the plane along z.
/// Starts level at the sample with the largest G K (the leftmost, then the topmost of equals), then
/// makes `iterations` weighted least squares with weights G K H and `ridge` sigma_s^2 sum(G K H) on
/// b and c.
struct PlaneFilter {
  const SparseDepthMap& samples;
  const SpatialKernel& spatial;
  std::array<const FloatImage*, 3> colour;              ///< of the samples' size; CIELAB, say
  std::array<std::span<const float>, 3> sample_colour;  ///< samples.ValuesAt of each
  float sigma_spatial_px = 20.0f;
  float sigma_colour = 25.0f;
  float sigma_depth_m = 0.030f;
  float ridge = 0.02f;
  int iterations = 5;  ///< >= 1
};

/// Images of the filter's size; only the filtered rows are written. Where no sample has weight, or
/// the plane lies behind infinity, the depth is NaN and all else 0.
struct PlaneFilterOutput {
  DepthImage& depth_m;  ///< 1 / a
  FloatImage& sum_gkh;  ///< of the last pass
  FloatImage& sum_gk;
  FloatImage& sum_gh;                     ///< of the last pass
  FloatImage& slope_x;                    ///< b, 1 / (m px)
  FloatImage& slope_y;                    ///< c, 1 / (m px)
  std::span<DepthImage> iterations = {};  ///< depth at the start and after each pass, or empty
};

/// Filters the rows top <= y < bottom. O(pixels * samples in Omega * passes).
void FilterPlaneRows(const PlaneFilter& filter, int top, int bottom,
                     const PlaneFilterOutput& output);

}  // namespace foresight
