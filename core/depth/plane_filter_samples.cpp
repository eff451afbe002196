#include <algorithm>
#include <cmath>

#include "core/depth/plane_filter.h"

// Compiled once per instruction set, as row_filter.cpp is.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/depth/plane_filter_samples.cpp"
#include "core/base/highway_targets.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/depth/plane_pass-inl.h"

HWY_BEFORE_NAMESPACE();
namespace foresight {
namespace HWY_NAMESPACE {

/// A candidate's plane after its last pass, in units of PlaneSample.
struct FittedPlane {
  float a = 0.0f, b = 0.0f, c = 0.0f;
  float sum_gkh = -1.0f;
};

/// Gathers the neighbours of sample q; returns the sum of their G K.
HWY_INLINE float GatherNeighbours(const PlaneFilter& filter, PlaneFilterScratch& scratch,
                                  std::size_t q, std::size_t count) {
  const Floats f;
  const SparseDepthMap& map = filter.samples;
  const SamplePlane& centre = filter.planes[q];
  const float depth_m = map.depths_m()[q];
  const float per_sigma = 1.0f / (filter.sigma_spatial_px * centre.unit);
  const float depth_scale = std::sqrt(0.5f * kLog2E) / (filter.sigma_depth_m * depth_m);
  const float k_scale = 0.5f * kLog2E / (filter.sigma_colour * filter.sigma_colour);
  const std::ptrdiff_t stride = filter.spatial.stride();
  const float* disc = filter.spatial.Centre() + map.rows()[q] * stride + map.columns()[q];
  float* HWY_RESTRICT weight = scratch.weight.data();
  float* HWY_RESTRICT spatial = weight + (count + kLanes - 1) / kLanes * kLanes;
  for (std::size_t i = 0; i < count; ++i) {
    const auto n = static_cast<std::size_t>(scratch.selected[i]);
    const float n_depth_m = map.depths_m()[n];
    scratch.samples[i] = {(filter.planes[n].x - centre.x) * per_sigma,
                          (filter.planes[n].y - centre.y) * per_sigma,
                          (depth_m - n_depth_m) / n_depth_m, n_depth_m * n_depth_m * depth_scale};
    float distance2 = 0.0f;
    for (const auto& colour : filter.sample_colour)
      distance2 += (colour[n] - colour[q]) * (colour[n] - colour[q]);
    weight[i] = distance2 * k_scale;
    spatial[i] = disc[-map.rows()[n] * stride - map.columns()[n]];
  }
  std::fill(weight + count, spatial, 0.0f);
  std::fill_n(spatial + count, spatial - weight - static_cast<std::ptrdiff_t>(count), 0.0f);
  Vector sum = hn::Zero(f);
  for (std::size_t i = 0; i < count; i += kLanes) {
    const Vector gk =
        hn::Mul(hn::Load(f, spatial + i), Exp2OfMinus<kWeightShift>(hn::Load(f, weight + i)));
    hn::Store(gk, f, weight + i);
    sum = hn::Add(sum, gk);
  }
  return hn::GetLane(hn::SumOfLanes(f, sum));
}

/// Fits as many candidates as a register has lanes, the first one being `first`, and returns the
/// best supported one.
HWY_INLINE FittedPlane FitCandidates(const PlaneFilter& filter, PlaneFilterScratch& scratch,
                                     const SlopeCandidates& candidates, int first,
                                     float slope_scale, std::size_t count) {
  const Floats f;
  alignas(64) float b[kLanes], c[kLanes], a[kLanes], w[kLanes];
  for (int lane = 0; lane < kLanes; ++lane) {
    const auto k = static_cast<std::size_t>((first + lane) % SlopeCandidates::kCount);
    b[lane] = candidates.x[k] * slope_scale;
    c[lane] = candidates.y[k] * slope_scale;
  }
  const Vector ridge = hn::Set(f, filter.ridge);
  const SharedWeights weights{scratch.weight.data()};
  Plane plane{hn::Zero(f), hn::Load(f, b), hn::Load(f, c)};
  Vector support = hn::Zero(f);
  for (int t = 0; t < filter.iterations; ++t) {
    const PlaneSums sums = PlanePass<false>(weights, scratch.samples.data(), count, plane);
    plane = Solve(sums, plane, ridge);
    support = sums.w;
  }
  hn::Store(plane.a, f, a);
  hn::Store(plane.b, f, b);
  hn::Store(plane.c, f, c);
  hn::Store(support, f, w);
  FittedPlane best;
  for (int lane = 0; lane < std::min(kLanes, SlopeCandidates::kCount); ++lane)
    if (w[lane] > best.sum_gkh) best = {a[lane], b[lane], c[lane], w[lane]};
  return best;
}

HWY_INLINE void FitSamplePlane(const PlaneFilter& filter, PlaneFilterScratch& scratch,
                               const SlopeCandidates& candidates, std::size_t q,
                               SamplePlane& plane) {
  const SparseDepthMap& map = filter.samples;
  const std::size_t count = SelectSamples(scratch.band, map.columns()[q], map.rows()[q], 1, 1,
                                          filter.spatial.radius(), scratch.selected.data());
  const float sum_gk = GatherNeighbours(filter, scratch, q, count);
  const float depth_m = map.depths_m()[q];
  const float slope_scale = depth_m * filter.sigma_spatial_px * plane.unit;
  FittedPlane best;
  for (int first = 0; first < SlopeCandidates::kCount; first += kLanes) {
    const FittedPlane fitted =
        FitCandidates(filter, scratch, candidates, first, slope_scale, count);
    if (fitted.sum_gkh > best.sum_gkh) best = fitted;
  }
  // Its own weight is 1, so a sample always has support.
  const bool in_front = 1.0f + best.a > 1e-6f;
  plane.inverse_depth = (in_front ? 1.0f + best.a : 1.0f) / depth_m;
  plane.slope_x = in_front ? best.b / slope_scale : 0.0f;
  plane.slope_y = in_front ? best.c / slope_scale : 0.0f;
  plane.support = std::max(0.0f, best.sum_gkh) / sum_gk;
}

void FitSamplePlanesHere(const PlaneFilter& filter, std::span<const SlopeCandidates> candidates,
                         int top, int bottom, std::span<SamplePlane> planes) {
  PlaneFilterScratch& scratch = PlaneScratchOfThisThread();
  const int radius = filter.spatial.radius();
  scratch.band.Load(filter.samples, top - radius, bottom + radius);
  const std::size_t most = scratch.band.size();
  scratch.selected.resize(most + kLanes);
  scratch.weight.Require(2 * (most + kLanes));
  scratch.samples.resize(most);
  for (std::int32_t i = filter.samples.First(top); i < filter.samples.First(bottom); ++i) {
    const auto q = static_cast<std::size_t>(i);
    FitSamplePlane(filter, scratch, candidates[q], q, planes[q]);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace foresight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace foresight {

HWY_EXPORT(FitSamplePlanesHere);

void FitSamplePlanes(const PlaneFilter& filter, std::span<const SlopeCandidates> candidates,
                     int top, int bottom, std::span<SamplePlane> planes) {
  FORESIGHT_EXPECTS(filter.iterations >= 1, "a plane needs at least one least squares");
  FORESIGHT_EXPECTS(filter.planes.size() == filter.samples.size() &&
                        planes.size() == filter.samples.size() &&
                        candidates.size() == filter.samples.size(),
                    "each sample has its plane and its candidates");
  HWY_DYNAMIC_DISPATCH(FitSamplePlanesHere)(filter, candidates, top, bottom, planes);
}

}  // namespace foresight
#endif
