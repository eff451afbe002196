#include "core/depth/connected_cells.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "core/base/parallel.h"

namespace foresight {
namespace {

/// In spacings of the samples.
constexpr double kWidestCell = 3.0;

/// Indices into the map.
using Triangle = std::array<std::int32_t, 3>;

struct Pixel {
  int x, y;
};

/// What decides whether a triangle lies on one surface, and where it lies.
class Surface {
 public:
  Surface(const SparseDepthMap& map, std::span<const SamplePlane> planes,
          const SampleSpacing& spacing, double tolerance_m)
      : map_(map),
        planes_(planes),
        tolerance_m_(static_cast<float>(tolerance_m)),
        widest_px_(static_cast<int>(kWidestCell * spacing.along_line_px)),
        highest_px_(static_cast<int>(kWidestCell * spacing.between_lines_px)) {}

  bool Holds(const Triangle& corners) const {
    if (std::any_of(corners.begin(), corners.end(), [](std::int32_t c) { return c < 0; }))
      return false;
    int left = map_.width(), right = 0, top = map_.height(), bottom = 0;
    for (const std::int32_t corner : corners) {
      const Pixel p = At(corner);
      left = std::min(left, p.x);
      right = std::max(right, p.x);
      top = std::min(top, p.y);
      bottom = std::max(bottom, p.y);
    }
    if (right - left > widest_px_ || bottom - top > highest_px_) return false;
    return Connected(corners[0], corners[1]) && Connected(corners[1], corners[2]) &&
           Connected(corners[2], corners[0]);
  }
  /// No triangle that holds spans more rows.
  int highest_px() const { return highest_px_; }
  Pixel At(std::int32_t corner) const {
    const auto c = static_cast<std::size_t>(corner);
    return {map_.columns()[c], map_.rows()[c]};
  }

 private:
  bool Connected(std::int32_t a, std::int32_t b) const {
    return std::abs(Depth(a) - Depth(b)) <= tolerance_m_ || (OnPlane(a, b) && OnPlane(b, a));
  }
  float Depth(std::int32_t sample) const {
    return map_.depths_m()[static_cast<std::size_t>(sample)];
  }
  /// Whether b lies on the plane of a.
  bool OnPlane(std::int32_t a, std::int32_t b) const {
    const SamplePlane& plane = planes_[static_cast<std::size_t>(a)];
    const SamplePlane& there = planes_[static_cast<std::size_t>(b)];
    const float inverse = plane.inverse_depth + plane.slope_x * (there.x - plane.x) +
                          plane.slope_y * (there.y - plane.y);
    return std::abs(Depth(b) * inverse - 1.0f) <= tolerance_m_ * inverse;
  }

  const SparseDepthMap& map_;
  std::span<const SamplePlane> planes_;
  float tolerance_m_;
  int widest_px_;
  int highest_px_;
};

/// Sets the pixels of a triangle, edges included. Several threads may set the same pixel.
void Fill(MaskImage& image, std::array<Pixel, 3> p) {
  std::sort(p.begin(), p.end(), [](const Pixel& a, const Pixel& b) { return a.y < b.y; });
  const auto along = [](const Pixel& a, const Pixel& b, int y) {
    return a.y == b.y ? static_cast<float>(b.x)
                      : static_cast<float>(a.x) + static_cast<float>((b.x - a.x) * (y - a.y)) /
                                                      static_cast<float>(b.y - a.y);
  };
  for (int y = p[0].y; y <= p[2].y; ++y) {
    const float one = along(p[0], p[2], y);
    const float other = y < p[1].y ? along(p[0], p[1], y) : along(p[1], p[2], y);
    float low = std::min(one, other), high = std::max(one, other);
    if (y == p[1].y) {  // the corner itself, also where an edge is level
      low = std::min(low, static_cast<float>(p[1].x));
      high = std::max(high, static_cast<float>(p[1].x));
    }
    const int to = static_cast<int>(high + 0.5f);
    for (int x = static_cast<int>(low + 0.5f); x <= to; ++x)
      std::atomic_ref(image(x, y)).store(255, std::memory_order_relaxed);
  }
}

}  // namespace

Result<MaskImage> InsideConnectedCells(const SparseDepthMap& map, const AlignedSamples& samples,
                                       std::span<const SamplePlane> planes,
                                       const SampleSpacing& spacing, double tolerance_m,
                                       const RunContext& context) {
  MaskImage inside(map.width(), map.height(), 0);
  FORESIGHT_CHECK(UpdateConnectedCells(map, samples, planes, spacing, tolerance_m,
                                       RowSet(map.height(), true), inside, context));
  return inside;
}

Status UpdateConnectedCells(const SparseDepthMap& map, const AlignedSamples& samples,
                            std::span<const SamplePlane> planes, const SampleSpacing& spacing,
                            double tolerance_m, const RowSet& changed, MaskImage& inside,
                            const RunContext& context) {
  const Image<std::int32_t> grid = MapGrid(map, samples);
  const Surface surface(map, planes, spacing, tolerance_m);
  const RowSet cleared = changed.GrownBy(surface.highest_px());
  for (int y = 0; y < inside.height(); ++y)
    if (cleared.Contains(y)) std::fill_n(inside.row(y), inside.width(), std::uint8_t{0});
  // Each stretch of cleared rows is higher than a triangle: what touches it has a corner in it.
  // Triangles that reach out of it did not change: there they set what is set.
  const auto touches = [&](const Triangle& corners) {
    return std::any_of(corners.begin(), corners.end(),
                       [&](std::int32_t c) { return c >= 0 && cleared.Contains(surface.At(c).y); });
  };
  const bool finished = ParallelFor(std::max(0, grid.height() - 1), context, [&](int line) {
    for (int beam = 0; beam + 1 < grid.width(); ++beam) {
      const std::array<std::int32_t, 4> cell{grid(beam, line), grid(beam + 1, line),
                                             grid(beam + 1, line + 1), grid(beam, line + 1)};
      const auto without = [&](std::size_t corner) {
        return Triangle{cell[(corner + 1) % 4], cell[(corner + 2) % 4], cell[(corner + 3) % 4]};
      };
      const auto fill = [&](const Triangle& corners) {
        if (touches(corners))
          Fill(inside, {surface.At(corners[0]), surface.At(corners[1]), surface.At(corners[2])});
      };
      // Two triangles are the whole cell; where one does not hold, one corner may be to blame.
      const bool first = surface.Holds(without(0)), second = surface.Holds(without(2));
      if (first) fill(without(0));
      if (second) fill(without(2));
      if (first && second) continue;
      for (const std::size_t corner : {1u, 3u})
        if (surface.Holds(without(corner))) fill(without(corner));
    }
  });
  if (!finished) return Fail(ErrorCode::kCancelled, "upsampling was cancelled");
  return {};
}

}  // namespace foresight
