#include "core/depth/row_filter.h"

#include <algorithm>
#include <cmath>
#include <limits>

// This file is compiled once per instruction set, and the processor's best is called.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/depth/row_filter.cpp"
#include "core/base/highway_targets.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/depth/filter_tile-inl.h"

#ifndef FORESIGHT_CORE_DEPTH_ROW_FILTER_ONCE_
#define FORESIGHT_CORE_DEPTH_ROW_FILTER_ONCE_
namespace foresight {
namespace {

/// What a thread needs to filter rows; kept from one block to the next.
struct JointFilterScratch {
  SampleBand band;
  std::vector<std::int32_t> selected;
  PaddedRows input;      ///< intensity, and 1 for pixels inside the image
  PaddedRows output;     ///< depth, confidence, D0 .. Dn
  AlignedFloats weight;  ///< of the tile's samples: G K and G, a register each
  AlignedFloats depth;   ///< of the tile's samples
  AlignedFloats change;  ///< a register a pass
};

/// Out of line: gcc otherwise asks for the thread's address again and again inside the kernel.
HWY_NOINLINE JointFilterScratch& ScratchOfThisThread() {
  thread_local JointFilterScratch scratch;
  return scratch;
}

}  // namespace
}  // namespace foresight
#endif

HWY_BEFORE_NAMESPACE();
namespace foresight {
namespace HWY_NAMESPACE {

/// Sums over the samples, a pixel a lane.
struct Sums {
  Vector weight;      ///< N_p
  Vector offset;      ///< sum of weight * (depth of the sample - last depth)
  Vector confidence;  ///< this pass's fraction of C

  // Written out: gcc compiles a constructor of its own making for the wrong instruction set.
  HWY_INLINE Sums()
      : weight(hn::Zero(Floats())), offset(hn::Zero(Floats())), confidence(hn::Zero(Floats())) {}

  HWY_INLINE Sums Plus(const Sums& other) const {
    Sums both;
    both.weight = hn::Add(weight, other.weight);
    both.offset = hn::Add(offset, other.offset);
    both.confidence = hn::Add(confidence, other.confidence);
    return both;
  }
  HWY_INLINE void Add(Vector weight_of_sample, Vector offset_of_sample, Vector fraction) {
    weight = hn::Add(weight, weight_of_sample);
    offset = hn::MulAdd(weight_of_sample, offset_of_sample, offset);
    confidence = hn::Add(confidence, fraction);
  }
};

/// Products: G K H for the weights, G H for the confidence. The lists hold G K, scaled, and G.
struct ProductTerms {
  static constexpr float kScale = kWeightScale;

  HWY_INLINE static Vector ListedWeight(Vector g, Vector k_exponent) {
    return hn::Mul(g, Exp2OfMinus<kWeightShift>(k_exponent));
  }
  HWY_INLINE static Vector ListedFraction(Vector g) { return g; }
  HWY_INLINE static Vector Unguided(Vector listed) { return listed; }
  HWY_INLINE static Vector Guided(Vector listed, Vector h) { return hn::Mul(listed, h); }
};

/// exp(G + K + H) and exp(G + H), as Eq. (8) and (9) print them: each weight lies in [1, e^3],
/// nothing is ever far away. Kept to show that this is not what produced the paper's tables. The
/// lists hold the negative exponents of two; 1000 stands for "outside the disc".
struct LiteralTerms {
  static constexpr float kScale = 1.0f;

  HWY_INLINE static Vector ListedWeight(Vector g, Vector k_exponent) {
    return InDisc(g, hn::Add(g, Exp2OfMinus(k_exponent)));
  }
  HWY_INLINE static Vector ListedFraction(Vector g) { return InDisc(g, g); }
  HWY_INLINE static Vector Unguided(Vector listed) { return Exp2OfMinus(listed); }
  HWY_INLINE static Vector Guided(Vector listed, Vector h) {
    return Exp2OfMinus(hn::NegMulAdd(h, hn::Set(Floats(), kLog2E), listed));
  }

 private:
  HWY_INLINE static Vector InDisc(Vector g, Vector sum) {
    const Floats f;
    return hn::IfThenElse(hn::Eq(g, hn::Zero(f)), hn::Set(f, 1000.0f),
                          hn::Mul(sum, hn::Set(f, -kLog2E)));
  }
};

/// How a pass sums: the form of the weights and that of the confidence are chosen apart.
template <class Weights, class Fractions>
struct Terms {
  static constexpr float kNoSupportScaled = kNoSupport * Weights::kScale;

  HWY_INLINE static void Prepare(Vector g, Vector k_exponent, Vector& weight, Vector& fraction) {
    weight = Weights::ListedWeight(g, k_exponent);
    fraction = Fractions::ListedFraction(g);
  }
  HWY_INLINE static void AddUnguided(Vector weight, Vector fraction, Vector offset, Sums& sums) {
    sums.Add(Weights::Unguided(weight), offset, Fractions::Unguided(fraction));
  }
  HWY_INLINE static void AddGuided(Vector weight, Vector fraction, Vector offset, Sums& sums) {
    const Vector h = Exp2OfMinus(hn::Mul(offset, offset));
    sums.Add(Weights::Guided(weight, h), offset, Fractions::Guided(fraction, h));
  }
};

/// Depths of one tile: metres from the tile's first sample, in units in which H is
/// 2^(-difference^2). A difference of floats keeps the digits that a float of 30 m does not have.
struct DepthUnit {
  float reference_m;
  float per_metre;

  float From(float depth_m) const { return (depth_m - reference_m) * per_metre; }
  HWY_INLINE Vector ToMetres(Vector depth) const {
    const Floats f;
    return hn::MulAdd(depth, hn::Set(f, 1.0f / per_metre), hn::Set(f, reference_m));
  }
};

/// Gathers the samples that reach one tile; on the way the first pass, relative to the reference.
template <class T>
HWY_INLINE Sums GatherTile(const JointFilter& filter, JointFilterScratch& scratch, int x, int y,
                           std::size_t count, const DepthUnit& unit) {
  const Floats f;
  const std::ptrdiff_t stride = filter.spatial.stride();
  // G is even, so neighbouring lanes read neighbouring places.
  const float* disc = filter.spatial.Centre() + y * stride + x;
  const Vector k_scale =
      hn::Set(f, kLog2E / (2.0f * filter.sigma_intensity * filter.sigma_intensity));
  const Vector intensity = LoadTile(scratch.input.Row(0, 0) + x, scratch.input.stride());
  float* HWY_RESTRICT weight = scratch.weight.data();
  float* HWY_RESTRICT depth = scratch.depth.data();
  const std::int32_t* HWY_RESTRICT columns = filter.samples.columns().data();
  const std::int32_t* HWY_RESTRICT rows = filter.samples.rows().data();
  Sums sums;
  for (std::size_t i = 0; i < count; ++i) {
    const auto q = static_cast<std::size_t>(scratch.selected[i]);
    const Vector g = LoadTile(disc - rows[q] * stride - columns[q], stride);
    const Vector difference = hn::Sub(intensity, hn::Set(f, filter.sample_intensity[q]));
    Vector listed, fraction;
    T::Prepare(g, hn::Mul(hn::Mul(difference, k_scale), difference), listed, fraction);
    hn::Store(listed, f, weight + 2 * i * kLanes);
    hn::Store(fraction, f, weight + (2 * i + 1) * kLanes);
    depth[i] = unit.From(filter.samples.depths_m()[q]);
    T::AddUnguided(listed, fraction, hn::Set(f, depth[i]), sums);
  }
  return sums;
}

/// One pass in which H compares the samples with `last`, the pixels' depth. Even and odd samples
/// are summed apart: an addition then need not wait for the one before it.
template <class T>
HWY_INLINE Sums GuidedPass(const float* HWY_RESTRICT weight, const float* HWY_RESTRICT depth,
                           std::size_t count, Vector last) {
  const Floats f;
  Sums even, odd;
  const auto add = [&](std::size_t i, Sums& sums) HWY_ATTR {
    // Relative to the last depth: a sum of small numbers keeps its digits.
    T::AddGuided(hn::Load(f, weight + 2 * i * kLanes), hn::Load(f, weight + (2 * i + 1) * kLanes),
                 hn::Sub(hn::Set(f, depth[i]), last), sums);
  };
  std::size_t i = 0;
  for (; i + 1 < count; i += 2) {
    add(i, even);
    add(i + 1, odd);
  }
  if (i < count) add(i, even);
  return even.Plus(odd);
}

/// The step to the weighted mean; lanes without support step nowhere.
template <class T>
HWY_INLINE Vector Step(const Sums& sums) {
  const auto supported = hn::Gt(sums.weight, hn::Set(Floats(), T::kNoSupportScaled));
  return hn::IfThenElseZero(supported, hn::Div(sums.offset, sums.weight));
}

/// Filters the pixels of one tile into the scratch's output; returns how many have a depth.
template <class T>
HWY_INLINE std::int64_t FilterTile(const JointFilter& filter, JointFilterScratch& scratch, int x,
                                   int y, bool keep_iterations) {
  const Floats f;
  const std::ptrdiff_t stride = scratch.output.stride();
  float* output = scratch.output.Row(0, 0) + x;
  const std::ptrdiff_t plane = scratch.output.Row(1, 0) - scratch.output.Row(0, 0);
  const std::size_t count =
      SelectSamples(scratch.band, x, y, filter.spatial.radius(), scratch.selected.data());
  const DepthUnit unit{
      count > 0 ? filter.samples.depths_m()[static_cast<std::size_t>(scratch.selected[0])] : 0.0f,
      std::sqrt(0.5f * kLog2E) / filter.sigma_depth_m};

  const Sums first = GatherTile<T>(filter, scratch, x, y, count, unit);
  const auto supported = hn::Gt(first.weight, hn::Set(f, T::kNoSupportScaled));
  // NaN where there is no support: it stays so through all passes.
  const Vector nan = hn::Set(f, std::numeric_limits<float>::quiet_NaN());
  Vector depth = hn::IfThenElse(supported, Step<T>(first), nan);
  Vector confidence = filter.confidence == ConfidencePasses::kAll ? first.confidence : hn::Zero(f);
  if (keep_iterations) StoreTile(unit.ToMetres(depth), output + 2 * plane, stride);

  const Vector inside = LoadTile(scratch.input.Row(1, 0) + x, scratch.input.stride());
  const auto counted = hn::And(supported, hn::Gt(inside, hn::Zero(f)));
  for (int t = 0; t < filter.iterations; ++t) {
    const Sums sums = GuidedPass<T>(scratch.weight.data(), scratch.depth.data(), count, depth);
    const Vector step = Step<T>(sums);
    depth = hn::Add(depth, step);
    confidence = hn::Add(confidence, sums.confidence);
    float* change = scratch.change.data() + t * kLanes;
    const Vector size = hn::Mul(hn::Abs(step), hn::Set(f, 1.0f / unit.per_metre));
    hn::Store(hn::Add(hn::Load(f, change), hn::IfThenElseZero(counted, size)), f, change);
    if (keep_iterations) StoreTile(unit.ToMetres(depth), output + (3 + t) * plane, stride);
  }
  if (filter.confidence == ConfidencePasses::kEveryDepth)
    confidence = hn::Add(
        confidence,
        GuidedPass<T>(scratch.weight.data(), scratch.depth.data(), count, depth).confidence);
  StoreTile(unit.ToMetres(depth), output, stride);
  StoreTile(hn::IfThenElseZero(supported, confidence), output + plane, stride);
  return static_cast<std::int64_t>(hn::CountTrue(f, counted));
}

/// Fills the scratch's input with the rows top <= y < bottom of the guide.
void LoadGuide(const GrayImage& guide, int top, int bottom, PaddedRows& input) {
  input.Reset(2, kTileRows, guide.width());
  for (int y = top; y < bottom; ++y) {
    std::copy_n(guide.row(y), guide.width(), input.Row(0, y - top));
    std::fill_n(input.Row(1, y - top), guide.width(), 1.0f);
  }
}

void StoreOutput(PaddedRows& rows, int top, int bottom, const JointFilterOutput& output) {
  const int width = output.depth_m.width();
  for (int y = top; y < bottom; ++y) {
    std::copy_n(rows.Row(0, y - top), width, output.depth_m.row(y));
    std::copy_n(rows.Row(1, y - top), width, output.confidence.row(y));
    for (std::size_t t = 0; t < output.iterations.size(); ++t)
      std::copy_n(rows.Row(2 + static_cast<int>(t), y - top), width, output.iterations[t].row(y));
  }
}

template <class T>
void FilterRowsWith(const JointFilter& filter, int top, int bottom, const JointFilterOutput& output,
                    FilterChange& change) {
  JointFilterScratch& scratch = ScratchOfThisThread();
  const int width = filter.guide.width();
  const int radius = filter.spatial.radius();
  const auto passes = static_cast<std::size_t>(filter.iterations);
  scratch.band.Load(filter.samples, top - radius, bottom + radius);
  const std::size_t most = scratch.band.size();
  scratch.selected.resize(most + kLanes);
  scratch.weight.Require(2 * kLanes * (most + 1));
  scratch.depth.Require(most + 1);
  std::fill_n(scratch.change.Require(passes * kLanes + 1), passes * kLanes, 0.0f);
  scratch.output.Reset(2 + static_cast<int>(output.iterations.size()), kTileRows, width);
  for (int y = top; y < bottom; y += kTileRows) {
    const int end = std::min(y + kTileRows, bottom);
    LoadGuide(filter.guide, y, end, scratch.input);
    for (int x = 0; x < width; x += kTileColumns)
      change.pixels += FilterTile<T>(filter, scratch, x, y, !output.iterations.empty());
    StoreOutput(scratch.output, y, end, output);
  }
  for (std::size_t i = 0; i < passes * kLanes; ++i)
    change.sum_m[i / kLanes] += static_cast<double>(scratch.change.data()[i]);
}

void FilterRowsHere(const JointFilter& filter, int top, int bottom, const JointFilterOutput& output,
                    FilterChange& change) {
  using Filter = void (*)(const JointFilter&, int, int, const JointFilterOutput&, FilterChange&);
  // [literal weights][literal confidence]
  static constexpr Filter kFilters[2][2] = {{FilterRowsWith<Terms<ProductTerms, ProductTerms>>,
                                             FilterRowsWith<Terms<ProductTerms, LiteralTerms>>},
                                            {FilterRowsWith<Terms<LiteralTerms, ProductTerms>>,
                                             FilterRowsWith<Terms<LiteralTerms, LiteralTerms>>}};
  kFilters[filter.literal_weights ? 1 : 0][filter.literal_confidence ? 1 : 0](filter, top, bottom,
                                                                              output, change);
}

}  // namespace HWY_NAMESPACE
}  // namespace foresight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace foresight {

HWY_EXPORT(FilterRowsHere);

void FilterRows(const JointFilter& filter, int top, int bottom, const JointFilterOutput& output,
                FilterChange& change) {
  HWY_DYNAMIC_DISPATCH(FilterRowsHere)(filter, top, bottom, output, change);
}

}  // namespace foresight
#endif
