// What the vector kernels of the joint filters share: tiles of pixels in a register, the
// exponential, the samples in reach. Included once per instruction set; see
// docs/adr/0007-highway.md.
#if defined(FORESIGHT_CORE_DEPTH_FILTER_TILE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FORESIGHT_CORE_DEPTH_FILTER_TILE_INL_H_
#undef FORESIGHT_CORE_DEPTH_FILTER_TILE_INL_H_
#else
#define FORESIGHT_CORE_DEPTH_FILTER_TILE_INL_H_
#endif

#include <hwy/highway.h>

#include <cstdint>

#include "core/depth/filter_scratch.h"

HWY_BEFORE_NAMESPACE();
namespace foresight {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using Ints = hn::RebindToSigned<Floats>;
using Vector = hn::Vec<Floats>;

constexpr float kLog2E = 1.44269504f;
/// Below this sum of weights a pass has no opinion and the pixel keeps its depth.
constexpr float kNoSupport = 1e-30f;
/// G K is kept this many powers of two too large, so that G K H stays out of the slow denormal
/// numbers.
constexpr int kWeightShift = 60;
constexpr float kWeightScale = static_cast<float>(1LL << kWeightShift);

constexpr int kLanes = static_cast<int>(hn::MaxLanes(Floats()));
// A tile is the pixels of one register. Two rows of 8 have 18 % fewer samples in reach than one row
// of 16: fewer lanes compute with a weight of zero.
constexpr int kTileRows = kLanes >= 8 ? 2 : 1;
constexpr int kTileColumns = kLanes / kTileRows;

#if HWY_TARGET == HWY_SCALAR || HWY_MAX_BYTES < 32

/// One tile from a row-major plane; `upper_left` need not be aligned.
HWY_INLINE Vector LoadTile(const float* upper_left, std::ptrdiff_t) {
  return hn::LoadU(Floats(), upper_left);
}

HWY_INLINE void StoreTile(Vector v, float* upper_left, std::ptrdiff_t) {
  hn::StoreU(v, Floats(), upper_left);
}

#else

/// One tile from a row-major plane; `upper_left` need not be aligned.
HWY_INLINE Vector LoadTile(const float* upper_left, std::ptrdiff_t stride) {
  const hn::Half<Floats> half;
  return hn::Combine(Floats(), hn::LoadU(half, upper_left + stride), hn::LoadU(half, upper_left));
}

HWY_INLINE void StoreTile(Vector v, float* upper_left, std::ptrdiff_t stride) {
  const hn::Half<Floats> half;
  hn::StoreU(hn::LowerHalf(half, v), half, upper_left);
  hn::StoreU(hn::UpperHalf(half, v), half, upper_left + stride);
}

#endif

/// 2^(kShift - t) for t >= -60, with a relative error below 2e-7; t above 120 counts as 120.
template <int kShift = 0>
HWY_INLINE Vector Exp2OfMinus(Vector t) {
  const Floats f;
  // At this size a float has no fraction: adding rounds to the nearest whole number and leaves it
  // in the lowest bits, ready to become an exponent.
  const Vector magic = hn::Set(f, 12582912.0f + kShift);
  const Vector clamped = hn::Min(t, hn::Set(f, 120.0f));
  const Vector shifted = hn::Sub(magic, clamped);
  const Vector rest = hn::Add(clamped, hn::Sub(shifted, magic));  // -rest is the power's fraction
  // Minimax on [-1/2, 1/2] with the constant term held at 1.
  Vector p = hn::MulAdd(rest, hn::Set(f, -1.326472756e-3f), hn::Set(f, 9.671513556e-3f));
  p = hn::MulAdd(p, rest, hn::Set(f, -5.550733751e-2f));
  p = hn::MulAdd(p, rest, hn::Set(f, 2.402224207e-1f));
  p = hn::MulAdd(p, rest, hn::Set(f, -6.931469776e-1f));
  p = hn::MulAdd(p, rest, hn::Set(f, 1.0f));
  const Ints i;
  const auto exponent = hn::ShiftLeft<23>(hn::BitCast(i, shifted));
  return hn::BitCast(f, hn::Add(hn::BitCast(i, p), exponent));
}

/// Writes the indices of the samples not farther than the disc's radius from any pixel of the
/// rectangle at (x, y), in the band's order. `selected` has room for the band's size and a
/// register.
HWY_INLINE std::size_t SelectSamples(const SampleBand& band, int x, int y, int columns, int rows,
                                     int radius, std::int32_t* HWY_RESTRICT selected) {
  const Floats f;
  const Ints i;
  const Vector left = hn::Set(f, static_cast<float>(x));
  const Vector right = hn::Set(f, static_cast<float>(x + columns - 1));
  const Vector top = hn::Set(f, static_cast<float>(y));
  const Vector bottom = hn::Set(f, static_cast<float>(y + rows - 1));
  // Up to the next whole radius: samples beyond the disc find a weight of zero.
  const Vector reach2 = hn::Set(f, static_cast<float>((radius + 1) * (radius + 1)));
  const std::size_t end = band.First(x + columns + radius);
  std::size_t count = 0;
  for (std::size_t at = band.First(x - radius); at < end; at += kLanes) {
    const Vector sx = hn::LoadU(f, band.x() + at);
    const Vector sy = hn::LoadU(f, band.y() + at);
    const Vector dx = hn::Sub(sx, hn::Max(left, hn::Min(sx, right)));
    const Vector dy = hn::Sub(sy, hn::Max(top, hn::Min(sy, bottom)));
    const auto near =
        hn::And(hn::Lt(hn::MulAdd(dx, dx, hn::Mul(dy, dy)), reach2), hn::FirstN(f, end - at));
    const auto index = hn::LoadU(i, band.index() + at);
    const auto in_reach = hn::RebindMask(i, near);
    hn::StoreU(hn::Compress(index, in_reach), i, selected + count);
    count += hn::CountTrue(i, in_reach);
  }
  return count;
}

/// Those that reach the tile at (x, y).
HWY_INLINE std::size_t SelectSamples(const SampleBand& band, int x, int y, int radius,
                                     std::int32_t* HWY_RESTRICT selected) {
  return SelectSamples(band, x, y, kTileColumns, kTileRows, radius, selected);
}

}  // namespace HWY_NAMESPACE
}  // namespace foresight
HWY_AFTER_NAMESPACE();

#endif
