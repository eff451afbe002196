#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/depth/filter_window.h"

namespace foresight {

/// A sample as the plane filter sees it, with the plane of inverse depth through its neighbourhood:
///   rho(x, y) = inverse_depth + slope_x (x - this->x) + slope_y (y - this->y)
/// over the coordinates x, y of the rays: X/Z and Y/Z, or pixels in a pinhole's image.
struct SamplePlane {
  float x = 0.0f;
  float y = 0.0f;
  float unit = 1.0f;           ///< coordinates a pixel, here
  float inverse_depth = 0.0f;  ///< 1 / m
  float slope_x = 0.0f;        ///< 1 / m and coordinate
  float slope_y = 0.0f;
  float support = 1.0f;  ///< the fraction of its neighbours' weight that agrees, in [0, 1]
};

/// Slopes from which the search for a sample's plane starts. Eight, as many as the narrowest common
/// register holds; unused ones repeat another.
struct SlopeCandidates {
  static constexpr int kCount = 8;
  std::array<float, kCount> x{};
  std::array<float, kCount> y{};
};

/// The joint filter's first-order relative: fits rho = a + b dx + c dy to the samples' inverse
/// depths, dx and dy in the rays' coordinates from the pixel. A plane in space is exactly that.
///   G as in Eq. (8), over pixels; K = exp(-|colour - colour of the sample|^2 / (2 sigma_c^2));
///   H = exp(-e^2 / (2 sigma_d^2)), e = (rho_q - rho(q)) R_q^2: to first order metres to the plane
///   along z.
/// Starts at the sample with the largest G K support (the leftmost, then the topmost of equals),
/// halfway between its depth and its plane's, with its plane's slopes, then makes `iterations`
/// weighted least squares with weights G K H and `ridge` (sigma_s unit)^2 sum(G K H) on b and c.
struct PlaneFilter {
  const SparseDepthMap& samples;
  std::span<const SamplePlane> planes;  ///< one a sample
  const SpatialKernel& spatial;
  std::array<const FloatImage*, 3> colour;              ///< of the samples' size; CIELAB, say
  std::array<std::span<const float>, 3> sample_colour;  ///< samples.ValuesAt of each
  std::array<const FloatImage*, 2> ray{};               ///< x and y; null = columns and rows
  float sigma_spatial_px = 20.0f;
  float sigma_colour = 25.0f;
  float sigma_depth_m = 0.030f;
  float ridge = 0.02f;
  int iterations = 5;  ///< >= 1
};

/// Images as wide as the filter's; row r is the image's row top + r. Where no sample has weight, or
/// the inverse depth is not positive, the depth is NaN and all else 0.
struct PlaneFilterOutput {
  DepthImage& depth_m;  ///< 1 / a
  FloatImage& sum_gkh;  ///< of the last pass
  FloatImage& sum_gk;
  FloatImage& sum_gh;                     ///< of the last pass
  FloatImage& slope_x;                    ///< b
  FloatImage& slope_y;                    ///< c
  std::span<DepthImage> iterations = {};  ///< depth at the start and after each pass, or empty
};

/// Filters the rows top <= y < bottom. O(pixels * samples in Omega * passes).
void FilterPlaneRows(const PlaneFilter& filter, int top, int bottom,
                     const PlaneFilterOutput& output);

/// Finds the planes of the samples of the rows top <= y < bottom: the filter at each sample's own
/// pixel, from each candidate; the one with the largest sum of G K H wins (the first of equals).
/// Writes inverse_depth, the slopes and support = sum(G K H) / sum(G K), both of the last pass.
/// Where the inverse depth is not positive the sample stays level. `filter.planes` need only hold
/// x, y and unit; `planes` may be the same samples' planes. O(samples * samples in Omega * passes).
void FitSamplePlanes(const PlaneFilter& filter, std::span<const SlopeCandidates> candidates,
                     int top, int bottom, std::span<SamplePlane> planes);

}  // namespace foresight
