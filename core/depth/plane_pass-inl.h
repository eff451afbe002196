// What the kernels of the plane filter share: a pass over a register's samples and the least
// squares. Included once per instruction set; see docs/adr/0007-highway.md.
#if defined(FORESIGHT_CORE_DEPTH_PLANE_PASS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FORESIGHT_CORE_DEPTH_PLANE_PASS_INL_H_
#undef FORESIGHT_CORE_DEPTH_PLANE_PASS_INL_H_
#else
#define FORESIGHT_CORE_DEPTH_PLANE_PASS_INL_H_
#endif

#include "core/depth/filter_tile-inl.h"
#include "core/depth/plane_scratch.h"

HWY_BEFORE_NAMESPACE();
namespace foresight {
namespace HWY_NAMESPACE {

/// A plane of inverse depths a lane; units of PlaneSample.
struct Plane {
  Vector a, b, c;
};

/// The sums of one pass's normal equations, r = residual to the last plane.
struct PlaneSums {
  Vector w, x, y, xx, xy, yy, r, xr, yr;
  Vector gh;  ///< of the last pass only

  // Written out: gcc compiles a constructor of its own making for the wrong instruction set.
  HWY_INLINE PlaneSums()
      : w(hn::Zero(Floats())), x(w), y(w), xx(w), xy(w), yy(w), r(w), xr(w), yr(w), gh(w) {}
};

/// Weights of a tile's samples, a register each of G K and G.
struct TileWeights {
  const float* HWY_RESTRICT values;
  HWY_INLINE Vector Gk(std::size_t i) const { return hn::Load(Floats(), values + 2 * i * kLanes); }
  HWY_INLINE Vector G(std::size_t i) const {
    return hn::Load(Floats(), values + (2 * i + 1) * kLanes);
  }
};

/// Weights G K that all lanes share.
struct SharedWeights {
  const float* HWY_RESTRICT values;
  HWY_INLINE Vector Gk(std::size_t i) const { return hn::Set(Floats(), values[i]); }
  HWY_INLINE Vector G(std::size_t) const { return hn::Zero(Floats()); }
};

template <bool kLast, class Weights>
HWY_INLINE PlaneSums PlanePass(const Weights& weights, const PlaneSample* HWY_RESTRICT samples,
                               std::size_t count, const Plane& plane) {
  const Floats f;
  PlaneSums sums;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector x = hn::Set(f, samples[i].x);
    const Vector y = hn::Set(f, samples[i].y);
    const Vector here = hn::MulAdd(plane.b, x, hn::MulAdd(plane.c, y, plane.a));
    const Vector r = hn::Sub(hn::Set(f, samples[i].inverse_depth), here);
    const Vector e = hn::Mul(r, hn::Set(f, samples[i].per_metre));
    const Vector h = Exp2OfMinus(hn::Mul(e, e));
    const Vector w = hn::Mul(weights.Gk(i), h);
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
    if constexpr (kLast) sums.gh = hn::MulAdd(weights.G(i), h, sums.gh);
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

}  // namespace HWY_NAMESPACE
}  // namespace foresight
HWY_AFTER_NAMESPACE();

#endif
