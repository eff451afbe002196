#include "core/depth/reject_flipping.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "core/base/parallel.h"

namespace foresight {
namespace {

/// A cell of the lidar's grid, seen from the camera.
struct Cell {
  std::array<std::int32_t, 4> corners;  ///< sample indices, in order round the cell
  float farthest_m;                     ///< the largest depth of the corners
};

/// Side of a bucket: a cell of the lidar's grid touches a few, a bucket holds about one sample.
constexpr int kBucketPx = 8;

/// Where samples are: the indices of those in a bucket are sorted[first[bucket]] ..
/// first[bucket + 1].
struct Buckets {
  int columns = 0;
  int rows = 0;
  std::vector<std::int32_t> first;
  std::vector<std::int32_t> sorted;

  static int Place(float coordinate, int count) {
    return std::clamp(static_cast<int>((coordinate + 0.5f) / kBucketPx), 0, count - 1);
  }
  int Column(float u) const { return Place(u, columns); }
  int Row(float v) const { return Place(v, rows); }
  std::size_t Index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
};

Buckets SortIntoBuckets(const AlignedSamples& samples) {
  Buckets buckets;
  buckets.columns = (samples.width + kBucketPx - 1) / kBucketPx;
  buckets.rows = (samples.height + kBucketPx - 1) / kBucketPx;
  const auto bucket = [&](const AlignedSample& s) {
    return buckets.Index(buckets.Column(s.u), buckets.Row(s.v));
  };
  buckets.first.assign(buckets.Index(0, buckets.rows) + 1, 0);
  for (std::size_t i = 0; i < samples.samples.size(); ++i)
    if (samples.reasons[i] == RejectReason::kKept) ++buckets.first[bucket(samples.samples[i]) + 1];
  for (std::size_t p = 1; p < buckets.first.size(); ++p) buckets.first[p] += buckets.first[p - 1];
  buckets.sorted.resize(static_cast<std::size_t>(buckets.first.back()));
  std::vector<std::int32_t> next(buckets.first.begin(), buckets.first.end() - 1);
  for (std::size_t i = 0; i < samples.samples.size(); ++i)
    if (samples.reasons[i] == RejectReason::kKept)
      buckets.sorted[static_cast<std::size_t>(next[bucket(samples.samples[i])]++)] =
          static_cast<std::int32_t>(i);
  return buckets;
}

/// Twice the signed area of a, b, p.
float Cross(const AlignedSample& a, const AlignedSample& b, const AlignedSample& p) {
  return (b.u - a.u) * (p.v - a.v) - (b.v - a.v) * (p.u - a.u);
}

/// Edges count as inside: on rectified images whole rows of samples lie exactly on the cells'
/// edges.
bool InTriangle(const AlignedSample& a, const AlignedSample& b, const AlignedSample& c,
                const AlignedSample& p) {
  const float ab = Cross(a, b, p);
  const float bc = Cross(b, c, p);
  const float ca = Cross(c, a, p);
  return (ab >= 0.0f && bc >= 0.0f && ca >= 0.0f) || (ab <= 0.0f && bc <= 0.0f && ca <= 0.0f);
}

/// A cell can fold over when it is seen from aside, so it is tested as its two triangles.
bool InCell(const AlignedSamples& samples, const Cell& cell, const AlignedSample& p) {
  const auto& s = samples.samples;
  const auto at = [&](int corner) -> const AlignedSample& {
    return s[static_cast<std::size_t>(cell.corners[static_cast<std::size_t>(corner)])];
  };
  return InTriangle(at(0), at(1), at(2), p) || InTriangle(at(0), at(2), at(3), p);
}

/// Calls mark(index) for every sample that lies in the cell and behind it.
template <class Mark>
void MarkInvaders(const AlignedSamples& samples, const Buckets& buckets, const Cell& cell,
                  double margin_m, const Mark& mark) {
  float left = 1e9f, right = -1e9f, top = 1e9f, bottom = -1e9f;
  for (const std::int32_t corner : cell.corners) {
    const AlignedSample& s = samples.samples[static_cast<std::size_t>(corner)];
    left = std::min(left, s.u);
    right = std::max(right, s.u);
    top = std::min(top, s.v);
    bottom = std::max(bottom, s.v);
  }
  const auto limit = static_cast<float>(cell.farthest_m + margin_m);
  const int first_column = buckets.Column(left);
  const int last_column = buckets.Column(right);
  const int last_row = buckets.Row(bottom);
  for (int row = buckets.Row(top); row <= last_row; ++row) {
    const auto from = static_cast<std::size_t>(buckets.first[buckets.Index(first_column, row)]);
    const auto to = static_cast<std::size_t>(buckets.first[buckets.Index(last_column, row) + 1]);
    for (std::size_t i = from; i < to; ++i) {
      const std::int32_t index = buckets.sorted[i];
      const AlignedSample& p = samples.samples[static_cast<std::size_t>(index)];
      // The box first: a cell seen edge-on has no inside, and its edges no end.
      const bool in_box = p.u >= left && p.u <= right && p.v >= top && p.v <= bottom;
      if (p.depth_m > limit && in_box && InCell(samples, cell, p))
        mark(static_cast<std::size_t>(index));
    }
  }
}

}  // namespace

Status FlippingPointOptions::Check() const {
  if (!(margin_m >= 0.0) || !std::isfinite(margin_m))
    return Fail(ErrorCode::kInvalidOptions, "flipping points: margin_m {} is negative", margin_m);
  return {};
}

Status RejectFlipping(AlignedSamples& samples, const FlippingPointOptions& options,
                      const RunContext& context) {
  FORESIGHT_CHECK(options.Check());
  if (!options.enabled || samples.samples.empty()) return {};
  const Image<std::int32_t> grid = GridOf(samples, options.cells_from_kept_only);
  const Buckets buckets = SortIntoBuckets(samples);
  // Marked first and written afterwards: a cell stands whether or not its corners are rejected.
  // Workers only ever store 1; distinct bytes, so the rows do not disturb each other.
  std::vector<std::atomic<std::uint8_t>> marked(samples.samples.size());
  const bool finished = ParallelFor(std::max(0, grid.height() - 1), context, [&](int line) {
    for (int beam = 0; beam + 1 < grid.width(); ++beam) {
      const Cell cell{
          {grid(beam, line), grid(beam + 1, line), grid(beam + 1, line + 1), grid(beam, line + 1)},
          0.0f};
      if (std::any_of(cell.corners.begin(), cell.corners.end(),
                      [](std::int32_t c) { return c < 0; }))
        continue;
      Cell measured = cell;
      for (const std::int32_t corner : cell.corners)
        measured.farthest_m = std::max(measured.farthest_m,
                                       samples.samples[static_cast<std::size_t>(corner)].depth_m);
      MarkInvaders(samples, buckets, measured, options.margin_m,
                   [&](std::size_t i) { marked[i].store(1, std::memory_order_relaxed); });
    }
  });
  if (!finished) return Fail(ErrorCode::kCancelled, "flipping point rejection was cancelled");
  for (std::size_t i = 0; i < marked.size(); ++i)
    if (marked[i] != 0 && samples.reasons[i] == RejectReason::kKept)
      samples.reasons[i] = RejectReason::kFlipping;
  return {};
}

}  // namespace foresight
