#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/depth/plane_filter.h"

// Compiled once per instruction set, as row_filter.cpp is.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/depth/plane_filter_rows.cpp"
#include "core/base/highway_targets.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/depth/plane_pass-inl.h"

HWY_BEFORE_NAMESPACE();
namespace foresight {
namespace HWY_NAMESPACE {

/// Images of PlaneFilterOutput before its iterations.
constexpr int kPlaneImages = 6;

/// The samples' common origin and scale in a tile: its first sample's.
struct TileOrigin {
  float x = 0.0f;
  float y = 0.0f;
  float per_sigma = 1.0f;  ///< sigma_s a coordinate
  float depth_m = 1.0f;
};

HWY_INLINE TileOrigin OriginAt(const PlaneFilter& filter, std::size_t sample) {
  const SamplePlane& plane = filter.planes[sample];
  return {plane.x, plane.y, 1.0f / (filter.sigma_spatial_px * plane.unit),
          filter.samples.depths_m()[sample]};
}

/// What the tile's samples say before any plane.
struct PlaneStart {
  Plane plane;
  Vector sum_gk;
};

/// Gathers the samples that reach one tile and finds the one to start from.
HWY_INLINE PlaneStart GatherPlaneTile(const PlaneFilter& filter, PlaneFilterScratch& scratch, int x,
                                      int y, std::size_t count, const TileOrigin& origin) {
  const Floats f;
  const std::ptrdiff_t stride = filter.spatial.stride();
  const float* disc = filter.spatial.Centre() + y * stride + x;
  const Vector k_scale = hn::Set(f, 0.5f * kLog2E / (filter.sigma_colour * filter.sigma_colour));
  const float depth_scale = std::sqrt(0.5f * kLog2E) / (filter.sigma_depth_m * origin.depth_m);
  const float slope_scale = origin.depth_m / origin.per_sigma;
  const std::ptrdiff_t input_stride = scratch.input.stride();
  const Vector l = LoadTile(scratch.input.Row(0, 0) + x, input_stride);
  const Vector a = LoadTile(scratch.input.Row(1, 0) + x, input_stride);
  const Vector b = LoadTile(scratch.input.Row(2, 0) + x, input_stride);
  float* HWY_RESTRICT weight = scratch.weight.data();
  Vector best = hn::Zero(f), sum = hn::Zero(f);
  Plane start{best, best, best};
  for (std::size_t i = 0; i < count; ++i) {
    const auto q = static_cast<std::size_t>(scratch.selected[i]);
    const int column = filter.samples.columns()[q];
    const int row = filter.samples.rows()[q];
    const float depth_m = filter.samples.depths_m()[q];
    const SamplePlane& plane = filter.planes[q];
    const PlaneSample sample{(plane.x - origin.x) * origin.per_sigma,
                             (plane.y - origin.y) * origin.per_sigma,
                             (origin.depth_m - depth_m) / depth_m, depth_m * depth_m * depth_scale};
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
    const Vector trust = hn::Mul(gk, hn::Set(f, plane.support));
    const auto better = hn::Gt(trust, best);
    const float slope_x = plane.slope_x * slope_scale;
    const float slope_y = plane.slope_y * slope_scale;
    // Halfway between the noisy sample and the plane that smooths over it.
    const float smooth = plane.inverse_depth * origin.depth_m - 1.0f;
    const float at_origin =
        0.5f * (sample.inverse_depth + smooth) - slope_x * sample.x - slope_y * sample.y;
    start.a = hn::IfThenElse(better, hn::Set(f, at_origin), start.a);
    start.b = hn::IfThenElse(better, hn::Set(f, slope_x), start.b);
    start.c = hn::IfThenElse(better, hn::Set(f, slope_y), start.c);
    best = hn::Max(trust, best);
  }
  return {start, sum};
}

/// The plane's value at each lane's own pixel.
HWY_INLINE Vector AtPixels(PlaneFilterScratch& scratch, int x, const Plane& plane,
                           const TileOrigin& origin) {
  const Floats f;
  const std::ptrdiff_t stride = scratch.input.stride();
  const Vector scale = hn::Set(f, origin.per_sigma);
  const Vector rx = LoadTile(scratch.input.Row(3, 0) + x, stride);
  const Vector ry = LoadTile(scratch.input.Row(4, 0) + x, stride);
  const Vector px = hn::Mul(hn::Sub(rx, hn::Set(f, origin.x)), scale);
  const Vector py = hn::Mul(hn::Sub(ry, hn::Set(f, origin.y)), scale);
  return hn::MulAdd(plane.b, px, hn::MulAdd(plane.c, py, plane.a));
}

/// Depth at the tile's pixels, NaN where the inverse depth is not positive or not supported, or a
/// pixel has no ray.
HWY_INLINE Vector DepthOf(PlaneFilterScratch& scratch, int x, const Plane& plane, Vector sum_gk,
                          const TileOrigin& origin) {
  const Floats f;
  const Vector inverse = hn::Add(AtPixels(scratch, x, plane, origin), hn::Set(f, 1.0f));
  const auto valid = hn::And(hn::Gt(sum_gk, hn::Set(f, kNoSupport * kWeightScale)),
                             hn::Gt(inverse, hn::Set(f, 1e-6f)));
  const Vector nan = hn::Set(f, std::numeric_limits<float>::quiet_NaN());
  return hn::IfThenElse(valid, hn::Div(hn::Set(f, origin.depth_m), inverse), nan);
}

HWY_INLINE void StorePlaneTile(PlaneFilterScratch& scratch, int x, const Plane& plane,
                               const PlaneSums& last, Vector sum_gk, const TileOrigin& origin) {
  const Floats f;
  PaddedRows& output = scratch.output;
  const Vector depth = DepthOf(scratch, x, plane, sum_gk, origin);
  const auto valid = hn::Eq(depth, depth);
  const Vector unscale = hn::Set(f, 1.0f / kWeightScale);
  const Vector slope = hn::Set(f, origin.per_sigma / origin.depth_m);
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
  const TileOrigin origin =
      count > 0 ? OriginAt(filter, static_cast<std::size_t>(scratch.selected[0])) : TileOrigin();
  const PlaneStart start = GatherPlaneTile(filter, scratch, x, y, count, origin);
  const TileWeights weights{scratch.weight.data()};
  const Vector ridge = hn::Set(Floats(), filter.ridge);
  const auto keep = [&](const Plane& plane, int t) HWY_ATTR {
    if (keep_iterations)
      StoreTile(DepthOf(scratch, x, plane, start.sum_gk, origin),
                scratch.output.Row(kPlaneImages + t, 0) + x, scratch.output.stride());
  };
  Plane plane = start.plane;
  keep(plane, 0);
  for (int t = 1; t < filter.iterations; ++t) {
    plane = Solve(PlanePass<false>(weights, scratch.samples.data(), count, plane), plane, ridge);
    keep(plane, t);
  }
  const PlaneSums last = PlanePass<true>(weights, scratch.samples.data(), count, plane);
  plane = Solve(last, plane, ridge);
  keep(plane, filter.iterations);
  StorePlaneTile(scratch, x, plane, last, start.sum_gk, origin);
}

/// The colours and rays of one row of tiles.
void LoadInput(const PlaneFilter& filter, PlaneFilterScratch& scratch, int y, int rows, int width) {
  scratch.input.Reset(5, kTileRows, width);
  for (int row = 0; row < rows; ++row) {
    for (int plane = 0; plane < 3; ++plane)
      std::copy_n(filter.colour[static_cast<std::size_t>(plane)]->row(y + row), width,
                  scratch.input.Row(plane, row));
    if (filter.ray[0] != nullptr) {
      std::copy_n(filter.ray[0]->row(y + row), width, scratch.input.Row(3, row));
      std::copy_n(filter.ray[1]->row(y + row), width, scratch.input.Row(4, row));
    } else {
      std::iota(scratch.input.Row(3, row), scratch.input.Row(3, row) + width, 0.0f);
      std::fill_n(scratch.input.Row(4, row), width, static_cast<float>(y + row));
    }
  }
}

void FilterPlaneRowsHere(const PlaneFilter& filter, int top, int bottom,
                         const PlaneFilterOutput& output) {
  PlaneFilterScratch& scratch = PlaneScratchOfThisThread();
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
    LoadInput(filter, scratch, y, rows, width);
    for (int x = 0; x < width; x += kTileColumns)
      FilterPlaneTile(filter, scratch, x, y, !output.iterations.empty());
    for (std::size_t plane = 0; plane < images.size(); ++plane)
      for (int row = 0; row < rows; ++row)
        std::copy_n(scratch.output.Row(static_cast<int>(plane), row), width,
                    images[plane]->row(y - top + row));
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
  FORESIGHT_EXPECTS(filter.planes.size() == filter.samples.size(), "each sample has its plane");
  HWY_DYNAMIC_DISPATCH(FilterPlaneRowsHere)(filter, top, bottom, output);
}

}  // namespace foresight
#endif
