#include "core/depth/reject_flipping.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <optional>

#include "core/base/parallel.h"
#include "core/depth/sample_buckets.h"

namespace foresight {
namespace {

using Test = FlippingPointOptions::Test;
using Cells = FlippingPointOptions::Cells;

/// A cell of the lidar's grid, seen from the camera.
struct Cell {
  std::array<const AlignedSample*, 4> corners;  ///< in order round the cell
  float nearest_m;                              ///< of the corners
  float farthest_m;
  float left, right, top, bottom;
};

/// The cell with its first corner at (beam, line); none where a corner was not measured.
std::optional<Cell> CellAt(const AlignedSamples& samples, const Image<std::int32_t>& grid, int beam,
                           int line) {
  const std::array<std::int32_t, 4> corners = {grid(beam, line), grid(beam + 1, line),
                                               grid(beam + 1, line + 1), grid(beam, line + 1)};
  if (std::any_of(corners.begin(), corners.end(), [](std::int32_t c) { return c < 0; }))
    return std::nullopt;
  const AlignedSample& first = samples.samples[static_cast<std::size_t>(corners[0])];
  Cell cell{{}, first.depth_m, first.depth_m, first.u, first.u, first.v, first.v};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const AlignedSample& s = samples.samples[static_cast<std::size_t>(corners[i])];
    cell.corners[i] = &s;
    cell.nearest_m = std::min(cell.nearest_m, s.depth_m);
    cell.farthest_m = std::max(cell.farthest_m, s.depth_m);
    cell.left = std::min(cell.left, s.u);
    cell.right = std::max(cell.right, s.u);
    cell.top = std::min(cell.top, s.v);
    cell.bottom = std::max(cell.bottom, s.v);
  }
  return cell;
}

/// Twice the signed area of a, b, p.
float Cross(const AlignedSample& a, const AlignedSample& b, const AlignedSample& p) {
  return (b.u - a.u) * (p.v - a.v) - (b.v - a.v) * (p.u - a.u);
}

/// A sample's place in a triangle: twice the signed areas opposite to a, b and c.
struct Areas {
  float a, b, c;

  Areas(const AlignedSample& corner_a, const AlignedSample& corner_b, const AlignedSample& corner_c,
        const AlignedSample& p)
      : a(Cross(corner_b, corner_c, p)),
        b(Cross(corner_c, corner_a, p)),
        c(Cross(corner_a, corner_b, p)) {}

  /// Edges count as inside: on rectified images whole rows of samples lie exactly on the cells'
  /// edges.
  bool Inside() const {
    return (a >= 0.0f && b >= 0.0f && c >= 0.0f) || (a <= 0.0f && b <= 0.0f && c <= 0.0f);
  }
};

/// Fig. 4: further than all four corners of the cell that it lies in.
struct BehindTheCorners {
  double margin_m;

  bool Applies(const Cell&) const { return true; }
  double NearestLimit(const Cell& cell) const { return cell.farthest_m + margin_m; }
  bool InTriangle(const AlignedSample& a, const AlignedSample& b, const AlignedSample& c,
                  const AlignedSample& p) const {
    return Areas(a, b, c, p).Inside();
  }
};

/// Further than the triangle, where the sample is seen.
struct BehindTheSurface {
  double margin_m;
  double connected_step_m;

  bool Applies(const Cell& cell) const {
    return cell.farthest_m - cell.nearest_m <= connected_step_m;
  }
  double NearestLimit(const Cell& cell) const { return cell.nearest_m + margin_m; }
  bool InTriangle(const AlignedSample& a, const AlignedSample& b, const AlignedSample& c,
                  const AlignedSample& p) const {
    // A corner lies on the surface, and rounding must not put it behind.
    if (&p == &a || &p == &b || &p == &c) return false;
    const Areas areas(a, b, c, p);
    const float whole = areas.a + areas.b + areas.c;
    // Seen edge-on a triangle hides nothing.
    if (!areas.Inside() || whole == 0.0f) return false;
    const double inverse_depth =
        (areas.a / a.depth_m + areas.b / b.depth_m + areas.c / c.depth_m) / whole;
    return p.depth_m > 1.0 / inverse_depth + margin_m;
  }
};

/// Calls mark(index) for every sample that lies in the cell and behind it.
template <class Hidden, class Mark>
void MarkInvaders(const AlignedSamples& samples, const SampleBuckets& buckets, const Cell& cell,
                  const Hidden& hidden, const Mark& mark) {
  const auto limit = static_cast<float>(hidden.NearestLimit(cell));
  const auto& corners = cell.corners;
  buckets.ForEachNear(cell.left, cell.top, cell.right, cell.bottom, [&](std::size_t index) {
    const AlignedSample& p = samples.samples[index];
    // The box first: a cell seen edge-on has no inside, and its edges no end.
    const bool in_box =
        p.u >= cell.left && p.u <= cell.right && p.v >= cell.top && p.v <= cell.bottom;
    if (!(p.depth_m > limit) || !in_box) return;
    // A cell can fold over when it is seen from aside, so it is tested as its two triangles.
    if (hidden.InTriangle(*corners[0], *corners[1], *corners[2], p) ||
        hidden.InTriangle(*corners[0], *corners[2], *corners[3], p))
      mark(index);
  });
}

/// False when cancelled.
template <class Hidden>
bool RejectHidden(AlignedSamples& samples, Cells cells, const Hidden& hidden,
                  const RunContext& context) {
  const Image<std::int32_t> grid = GridOf(samples, cells == Cells::kFromKeptSamples);
  const SampleBuckets buckets(samples);
  // Marked first and written afterwards: a cell stands whether or not its corners are rejected.
  // Workers only ever store 1; distinct bytes, so the rows do not disturb each other.
  std::vector<std::atomic<std::uint8_t>> marked(samples.samples.size());
  const bool finished = ParallelFor(std::max(0, grid.height() - 1), context, [&](int line) {
    for (int beam = 0; beam + 1 < grid.width(); ++beam) {
      const std::optional<Cell> cell = CellAt(samples, grid, beam, line);
      if (cell && hidden.Applies(*cell))
        MarkInvaders(samples, buckets, *cell, hidden,
                     [&](std::size_t i) { marked[i].store(1, std::memory_order_relaxed); });
    }
  });
  if (!finished) return false;
  for (std::size_t i = 0; i < marked.size(); ++i)
    if (marked[i] != 0 && samples.reasons[i] == RejectReason::kKept)
      samples.reasons[i] = RejectReason::kFlipping;
  return true;
}

}  // namespace

Status FlippingPointOptions::Check() const {
  if (!(margin_m >= 0.0) || !std::isfinite(margin_m))
    return Fail(ErrorCode::kInvalidOptions, "flipping points: margin_m {} is negative", margin_m);
  if (!(connected_step_m > 0.0) || !std::isfinite(connected_step_m))
    return Fail(ErrorCode::kInvalidOptions, "flipping points: connected_step_m {} is not positive",
                connected_step_m);
  return {};
}

Status RejectFlipping(AlignedSamples& samples, const FlippingPointOptions& options,
                      const RunContext& context) {
  FORESIGHT_CHECK(options.Check());
  if (options.test == Test::kOff || samples.samples.empty()) return {};
  const bool finished =
      options.test == Test::kCells
          ? RejectHidden(samples, options.cells, BehindTheCorners{options.margin_m}, context)
          : RejectHidden(samples, options.cells,
                         BehindTheSurface{options.margin_m, options.connected_step_m}, context);
  if (!finished) return Fail(ErrorCode::kCancelled, "flipping point rejection was cancelled");
  return {};
}

}  // namespace foresight
