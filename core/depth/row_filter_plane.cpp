#include <algorithm>
#include <cmath>
#include <limits>

#include "core/depth/row_filter.h"

// Compiled once per instruction set, as row_filter.cpp is.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/depth/row_filter_plane.cpp"
#define HWY_DISABLED_TARGETS \
  (HWY_AVX3_DL | HWY_SSSE3 | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/depth/filter_tile-inl.h"

#ifndef FORESIGHT_CORE_DEPTH_ROW_FILTER_PLANE_ONCE_
#define FORESIGHT_CORE_DEPTH_ROW_FILTER_PLANE_ONCE_
namespace foresight {
namespace {

/// One sample seen from a tile, in units that keep all numbers near 1.
struct PlaneSample {
  float x;              ///< from the tile's first pixel, in sigma_s
  float y;              ///< likewise
  float inverse_depth;  ///< times that of the tile's first sample, minus 1
  float depth;          ///< in units in which H is 2^(-difference^2)
};

/// What a thread needs to filter rows; kept from one block to the next.
struct PlaneFilterScratch {
  SampleBand band;
  std::vector<std::int32_t> selected;
  PaddedRows input;                  ///< the three planes of colour
  PaddedRows output;                 ///< in the order of PlaneFilterOutput
  AlignedFloats weight;              ///< of the tile's samples: G K and G, a register each
  std::vector<PlaneSample> samples;  ///< of the tile
};

/// Out of line: gcc otherwise asks for the thread's address again and again inside the kernel.
HWY_NOINLINE PlaneFilterScratch& ScratchOfThisThread() {
  thread_local PlaneFilterScratch scratch;
  return scratch;
}

}  // namespace
}  // namespace foresight
#endif

HWY_BEFORE_NAMESPACE();
namespace foresight {
namespace HWY_NAMESPACE {

/// Images of PlaneFilterOutput before its iterations.
constexpr int kPlaneImages = 6;

/// A plane of inverse depths over the tile, a pixel a lane; units of PlaneSample.
struct Plane {
  Vector a, b, c;
};

/// What the tile's samples say before any plane.
struct PlaneStart {
  Plane plane;
  Vector sum_gk;
};

/// Gathers the samples that reach one tile and finds the one to start from.
HWY_INLINE PlaneStart GatherPlaneTile(const PlaneFilter& filter, PlaneFilterScratch& scratch, int x,
                                      int y, std::size_t count, float reference_m) {
  const Floats f;
  const std::ptrdiff_t stride = filter.spatial.stride();
  const float* disc = filter.spatial.Centre() + y * stride + x;
  const Vector k_scale = hn::Set(f, 0.5f * kLog2E / (filter.sigma_colour * filter.sigma_colour));
  const float depth_scale = std::sqrt(0.5f * kLog2E) / filter.sigma_depth_m;
  const float per_sigma = 1.0f / filter.sigma_spatial_px;
  const std::ptrdiff_t input_stride = scratch.input.stride();
  const Vector l = LoadTile(scratch.input.Row(0, 0) + x, input_stride);
  const Vector a = LoadTile(scratch.input.Row(1, 0) + x, input_stride);
  const Vector b = LoadTile(scratch.input.Row(2, 0) + x, input_stride);
  float* HWY_RESTRICT weight = scratch.weight.data();
  Vector best = hn::Zero(f), start = hn::Zero(f), sum = hn::Zero(f);
  for (std::size_t i = 0; i < count; ++i) {
    const auto q = static_cast<std::size_t>(scratch.selected[i]);
    const int column = filter.samples.columns()[q];
    const int row = filter.samples.rows()[q];
    const float depth_m = filter.samples.depths_m()[q];
    const PlaneSample sample{static_cast<float>(column - x) * per_sigma,
                             static_cast<float>(row - y) * per_sigma,
                             (reference_m - depth_m) / depth_m, depth_m * depth_scale};
    scratch.samples[i] = sample;
    const Vector g = LoadTile(disc - row * stride - column, stride);
    const Vector dl = hn::Sub(l, hn::Set(f, filter.sample_colour[0][q]));
    const Vector da = hn::Sub(a, hn::Set(f, filter.sample_colour[1][q]));
    const Vector db = hn::Sub(b, hn::Set(f, filter.sample_colour[2][q]));
    const Vector distance2 = hn::MulAdd(dl, dl, hn::MulAdd(da, da, hn::Mul(db, db)));
    const Vector gk = hn::Mul(g, Exp2OfMinus<kWeightShift>(hn::Mul(distance2, k_scale)));
    hn::Store(gk, f, weight + 2 * i * kLanes);
    hn::Store(g, f, weight + (2 * i + 1) * kLanes);
    sum = hn::Add(sum, gk);
    start = hn::IfThenElse(hn::Gt(gk, best), hn::Set(f, sample.inverse_depth), start);
    best = hn::Max(gk, best);
  }
  return {{start, hn::Zero(f), hn::Zero(f)}, sum};
}

/// The sums of one pass's normal equations, r = residual to the last plane.
struct PlaneSums {
  Vector w, x, y, xx, xy, yy, r, xr, yr;
  Vector gh;  ///< of the last pass only

  // Written out: gcc compiles a constructor of its own making for the wrong instruction set.
  HWY_INLINE PlaneSums()
      : w(hn::Zero(Floats())), x(w), y(w), xx(w), xy(w), yy(w), r(w), xr(w), yr(w), gh(w) {}
};

template <bool kLast>
HWY_INLINE PlaneSums PlanePass(const float* HWY_RESTRICT weight,
                               const PlaneSample* HWY_RESTRICT samples, std::size_t count,
                               const Plane& plane) {
  const Floats f;
  PlaneSums sums;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector x = hn::Set(f, samples[i].x);
    const Vector y = hn::Set(f, samples[i].y);
    const Vector here = hn::MulAdd(plane.b, x, hn::MulAdd(plane.c, y, plane.a));
    const Vector r = hn::Sub(hn::Set(f, samples[i].inverse_depth), here);
    // A plane at or behind infinity fits nothing: the residual becomes huge.
    const Vector inverse = hn::Max(hn::Add(here, hn::Set(f, 1.0f)), hn::Set(f, 1e-6f));
    // One step of Newton's makes the approximation exact enough, at a third of a division's cost.
    const Vector guess = hn::ApproximateReciprocal(inverse);
    const Vector depth = hn::Mul(guess, hn::NegMulAdd(inverse, guess, hn::Set(f, 2.0f)));
    const Vector e = hn::Mul(hn::Mul(r, hn::Set(f, samples[i].depth)), depth);
    const Vector h = Exp2OfMinus(hn::Mul(e, e));
    const Vector w = hn::Mul(hn::Load(f, weight + 2 * i * kLanes), h);
    const Vector wx = hn::Mul(w, x);
    const Vector wy = hn::Mul(w, y);
    sums.w = hn::Add(sums.w, w);
    sums.x = hn::Add(sums.x, wx);
    sums.y = hn::Add(sums.y, wy);
    sums.xx = hn::MulAdd(wx, x, sums.xx);
    sums.xy = hn::MulAdd(wx, y, sums.xy);
    sums.yy = hn::MulAdd(wy, y, sums.yy);
    sums.r = hn::MulAdd(w, r, sums.r);
    sums.xr = hn::MulAdd(wx, r, sums.xr);
    sums.yr = hn::MulAdd(wy, r, sums.yr);
    if constexpr (kLast)
      sums.gh = hn::MulAdd(hn::Load(f, weight + (2 * i + 1) * kLanes), h, sums.gh);
  }
  return sums;
}

/// Moves the plane to the least squares' solution: about the weighted mean, where a drops out and
/// two unknowns are left. Solving for the change keeps the digits. Without support it stays.
HWY_INLINE Plane Solve(const PlaneSums& sums, const Plane& plane, Vector ridge) {
  const Floats f;
  const auto supported = hn::Gt(sums.w, hn::Set(f, kNoSupport * kWeightScale));
  const Vector per_w = hn::IfThenElseZero(supported, hn::Div(hn::Set(f, 1.0f), sums.w));
  const Vector x = hn::Mul(sums.x, per_w);
  const Vector y = hn::Mul(sums.y, per_w);
  const Vector r = hn::Mul(sums.r, per_w);
  const Vector xx = hn::Add(hn::NegMulAdd(x, x, hn::Mul(sums.xx, per_w)), ridge);
  const Vector yy = hn::Add(hn::NegMulAdd(y, y, hn::Mul(sums.yy, per_w)), ridge);
  const Vector xy = hn::NegMulAdd(x, y, hn::Mul(sums.xy, per_w));
  const Vector xr = hn::NegMulAdd(ridge, plane.b, hn::NegMulAdd(x, r, hn::Mul(sums.xr, per_w)));
  const Vector yr = hn::NegMulAdd(ridge, plane.c, hn::NegMulAdd(y, r, hn::Mul(sums.yr, per_w)));
  const Vector determinant = hn::NegMulAdd(xy, xy, hn::Mul(xx, yy));
  const Vector scale = hn::IfThenElseZero(supported, hn::Div(hn::Set(f, 1.0f), determinant));
  const Vector b = hn::Mul(scale, hn::NegMulAdd(xy, yr, hn::Mul(yy, xr)));
  const Vector c = hn::Mul(scale, hn::NegMulAdd(xy, xr, hn::Mul(xx, yr)));
  const Vector a = hn::NegMulAdd(b, x, hn::NegMulAdd(c, y, r));
  return {hn::Add(plane.a, a), hn::Add(plane.b, b), hn::Add(plane.c, c)};
}

/// The plane's value at each lane's own pixel.
HWY_INLINE Vector AtPixels(const Plane& plane, float sigma_spatial_px) {
  const Floats f;
  alignas(64) float x[kLanes], y[kLanes];
  for (int lane = 0; lane < kLanes; ++lane) {
    x[lane] = static_cast<float>(lane % kTileColumns) / sigma_spatial_px;
    y[lane] = static_cast<float>(lane / kTileColumns) / sigma_spatial_px;
  }
  return hn::MulAdd(plane.b, hn::Load(f, x), hn::MulAdd(plane.c, hn::Load(f, y), plane.a));
}

/// Depth at the tile's pixels, NaN where the plane is behind infinity or not supported.
HWY_INLINE Vector DepthOf(const PlaneFilter& filter, const Plane& plane, Vector sum_gk,
                          float reference_m) {
  const Floats f;
  const Vector inverse = hn::Add(AtPixels(plane, filter.sigma_spatial_px), hn::Set(f, 1.0f));
  const auto valid = hn::And(hn::Gt(sum_gk, hn::Set(f, kNoSupport * kWeightScale)),
                             hn::Gt(inverse, hn::Set(f, 1e-6f)));
  const Vector nan = hn::Set(f, std::numeric_limits<float>::quiet_NaN());
  return hn::IfThenElse(valid, hn::Div(hn::Set(f, reference_m), inverse), nan);
}

HWY_INLINE void StorePlaneTile(const PlaneFilter& filter, PaddedRows& output, int x,
                               const Plane& plane, const PlaneSums& last, Vector sum_gk,
                               float reference_m) {
  const Floats f;
  const Vector depth = DepthOf(filter, plane, sum_gk, reference_m);
  const auto valid = hn::Eq(depth, depth);
  const Vector unscale = hn::Set(f, 1.0f / kWeightScale);
  const Vector slope = hn::Set(f, 1.0f / (reference_m * filter.sigma_spatial_px));
  const std::ptrdiff_t stride = output.stride();
  StoreTile(depth, output.Row(0, 0) + x, stride);
  StoreTile(hn::IfThenElseZero(valid, hn::Mul(last.w, unscale)), output.Row(1, 0) + x, stride);
  StoreTile(hn::IfThenElseZero(valid, hn::Mul(sum_gk, unscale)), output.Row(2, 0) + x, stride);
  StoreTile(hn::IfThenElseZero(valid, last.gh), output.Row(3, 0) + x, stride);
  StoreTile(hn::IfThenElseZero(valid, hn::Mul(plane.b, slope)), output.Row(4, 0) + x, stride);
  StoreTile(hn::IfThenElseZero(valid, hn::Mul(plane.c, slope)), output.Row(5, 0) + x, stride);
}

HWY_INLINE void FilterPlaneTile(const PlaneFilter& filter, PlaneFilterScratch& scratch, int x,
                                int y, bool keep_iterations) {
  const std::size_t count =
      SelectSamples(scratch.band, x, y, filter.spatial.radius(), scratch.selected.data());
  const float reference_m =
      count > 0 ? filter.samples.depths_m()[static_cast<std::size_t>(scratch.selected[0])] : 1.0f;
  const PlaneStart start = GatherPlaneTile(filter, scratch, x, y, count, reference_m);
  const Vector ridge = hn::Set(Floats(), filter.ridge);
  const auto keep = [&](const Plane& plane, int t) HWY_ATTR {
    if (keep_iterations)
      StoreTile(DepthOf(filter, plane, start.sum_gk, reference_m),
                scratch.output.Row(kPlaneImages + t, 0) + x, scratch.output.stride());
  };
  Plane plane = start.plane;
  keep(plane, 0);
  for (int t = 1; t < filter.iterations; ++t) {
    plane = Solve(PlanePass<false>(scratch.weight.data(), scratch.samples.data(), count, plane),
                  plane, ridge);
    keep(plane, t);
  }
  const PlaneSums last =
      PlanePass<true>(scratch.weight.data(), scratch.samples.data(), count, plane);
  plane = Solve(last, plane, ridge);
  keep(plane, filter.iterations);
  StorePlaneTile(filter, scratch.output, x, plane, last, start.sum_gk, reference_m);
}

void FilterPlaneRowsHere(const PlaneFilter& filter, int top, int bottom,
                         const PlaneFilterOutput& output) {
  PlaneFilterScratch& scratch = ScratchOfThisThread();
  const int width = filter.samples.width();
  const int radius = filter.spatial.radius();
  std::vector<FloatImage*> images = {&output.depth_m, &output.sum_gkh, &output.sum_gk,
                                     &output.sum_gh,  &output.slope_x, &output.slope_y};
  for (DepthImage& iteration : output.iterations) images.push_back(&iteration);
  scratch.band.Load(filter.samples, top - radius, bottom + radius);
  const std::size_t most = scratch.band.size();
  scratch.selected.resize(most + kLanes);
  scratch.weight.Require(2 * kLanes * (most + 1));
  scratch.samples.resize(most);
  scratch.output.Reset(static_cast<int>(images.size()), kTileRows, width);
  for (int y = top; y < bottom; y += kTileRows) {
    const int rows = std::min(kTileRows, bottom - y);
    scratch.input.Reset(3, kTileRows, width);
    for (int plane = 0; plane < 3; ++plane)
      for (int row = 0; row < rows; ++row)
        std::copy_n(filter.colour[static_cast<std::size_t>(plane)]->row(y + row), width,
                    scratch.input.Row(plane, row));
    for (int x = 0; x < width; x += kTileColumns)
      FilterPlaneTile(filter, scratch, x, y, !output.iterations.empty());
    for (std::size_t plane = 0; plane < images.size(); ++plane)
      for (int row = 0; row < rows; ++row)
        std::copy_n(scratch.output.Row(static_cast<int>(plane), row), width,
                    images[plane]->row(y + row));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace foresight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace foresight {

HWY_EXPORT(FilterPlaneRowsHere);

void FilterPlaneRows(const PlaneFilter& filter, int top, int bottom,
                     const PlaneFilterOutput& output) {
  FORESIGHT_EXPECTS(filter.iterations >= 1, "a plane needs at least one least squares");
  HWY_DYNAMIC_DISPATCH(FilterPlaneRowsHere)(filter, top, bottom, output);
}

}  // namespace foresight
#endif
